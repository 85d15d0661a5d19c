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
inline constexpr const char* verdict = "verdict.json";

}  // namespace vesica::io::file_names
