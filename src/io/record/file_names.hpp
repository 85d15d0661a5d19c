#pragma once

/// Names of the files in the folder of a run (docs/output.md).
namespace vesica::io::file_names {

inline constexpr const char* record = "trajectory.h5";
inline constexpr const char* part = "trajectory.part.h5";       // while the run goes on
inline constexpr const char* new_part = "trajectory.part.tmp";  // until it has its first frame
inline constexpr const char* journal = "trajectory.part.journal";
inline constexpr const char* xdmf = "trajectory.xdmf";
inline constexpr const char* part_xdmf = "trajectory.part.xdmf";
inline constexpr const char* configuration = "case.toml";
// the last state alone, a record of one frame, and the one before it
inline constexpr const char* checkpoint = "checkpoint.h5";
inline constexpr const char* previous_checkpoint = "checkpoint.previous.h5";
inline constexpr const char* new_checkpoint = "checkpoint.new.tmp";
inline constexpr const char* new_checkpoint_journal = "checkpoint.new.journal";
inline constexpr const char* damaged = "trajectory.damaged.h5";  // a record that was set aside
inline constexpr const char* verdict = "verdict.json";

}  // namespace vesica::io::file_names
