#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "io/record/record_reader.hpp"
#include "program_test.hpp"
#include "programs.hpp"
#include "vesica/io/run_reader.hpp"

namespace vesica {
namespace {

namespace fs = std::filesystem;

/// Short runs of every kind that writes files: arguments without --out, and the folders of the
/// runs, relative to that of --out.
struct ShortRun {
  const char* name;
  const char* program;
  const char* arguments;
  std::vector<std::string> folders;
};
const std::vector<ShortRun> short_runs{
    {"flow", program_relax, "case.toml --set stop.max_steps=6", {""}},
    {"adaptive flow",
     program_relax,
     "case.toml --set stop.max_steps=6 --set adaption.enabled=true --set "
     "adaption.max_nodes=200",
     {""}},
    {"minimiser", program_relax, "case.toml --set solver.method=minimize", {""}},
    {"comparison", program_compare, "case.toml --set-flow stop.max_steps=4", {"flow", "minimize"}}};

/// Kills runs at one of the calls that change files, goes on with them and looks at every frame.
class KillTest : public test::ProgramTest {
 protected:
  KillTest() {
    write("case.toml", std::string(test::prolate_case) + "[output]\nevery_steps = 1\n");
  }

  /// Number of the calls of an undisturbed run.
  long count_calls(const ShortRun& run) {
    const std::string count = (folder_ / "count").string();
    (void)start(run, "COUNT_FILE='" + count + "'");
    long calls = 0;
    std::ifstream(count) >> calls;
    fs::remove_all(folder_ / "out");
    return calls;
  }

  /// What happens to the call at which the program is killed, and to those before it.
  enum class Loss { nothing, half_of_the_call, power };

  /// Checks a kill before call number `call`.
  void check(const ShortRun& run, long call, Loss loss) {
    std::string environment = "KILL_AT=" + std::to_string(call);
    if (loss == Loss::half_of_the_call) environment += " KILL_PARTIAL=1";
    if (loss == Loss::power) environment += " POWER_LOSS=" + std::to_string(call);
    SCOPED_TRACE(std::string(run.name) + ", " + environment);
    ASSERT_EQ(start(run, environment), 137) << output_;
    for (const std::string& name : run.folders) check_folder(folder_ / "out" / name);
    fs::remove_all(folder_ / "out");
  }

 private:
  int start(const ShortRun& run, const std::string& environment) {
    return ProgramTest::run("/usr/bin/env", environment + " LD_PRELOAD='" + library_kill_at +
                                                "' '" + run.program + "' " + run.arguments +
                                                " --quiet --out out");
  }

  void check_folder(const fs::path& folder) {
    const std::vector<io::XdmfFrame> announced = frames_in(folder);
    ASSERT_GE(announced.size(), num_announced(folder));
    if (announced.empty()) return;
    const int status =
        ProgramTest::run(program_relax, "--quiet --resume '" + folder.string() + "'");
    ASSERT_TRUE(status == 0 || status == 1) << output_;
    const std::vector<io::XdmfFrame> found = frames_in(folder);
    ASSERT_GE(found.size(), announced.size());
    for (std::size_t i = 0; i < announced.size(); ++i) {
      EXPECT_EQ(found[i].step, announced[i].step);
      EXPECT_EQ(found[i].mesh, announced[i].mesh);
    }
    check_each_once(folder, found);
    EXPECT_NO_THROW((void)io::read_run(folder));
    EXPECT_FALSE(fs::exists(folder / "trajectory.part.h5"));
    EXPECT_FALSE(fs::exists(folder / "trajectory.part.journal"));
  }

  /// No step is missing. A step has two frames on two meshes, or where the run ended before and
  /// the last solve moved the nodes.
  static void check_each_once(const fs::path& folder, const std::vector<io::XdmfFrame>& frames) {
    const io::RecordReader record(folder / "trajectory.h5");
    EXPECT_EQ(frames.front().step, 0);
    for (std::size_t i = 1; i < frames.size(); ++i) {
      EXPECT_TRUE(frames[i].step == frames[i - 1].step || frames[i].step == frames[i - 1].step + 1);
      if (frames[i].step != frames[i - 1].step || frames[i].mesh != frames[i - 1].mesh) continue;
      EXPECT_NE(record.frame(i).state.values.positions, record.frame(i - 1).state.values.positions)
          << "step " << frames[i].step;
    }
  }

  static std::vector<io::XdmfFrame> frames_in(const fs::path& folder) {
    for (const char* name : {"trajectory.part.h5", "trajectory.h5"})
      if (fs::exists(folder / name)) return io::RecordReader(folder / name).frames();
    return {};
  }

  /// Frames that the file for ParaView names.
  static std::size_t num_announced(const fs::path& folder) {
    std::set<std::string> groups;
    for (const char* name : {"trajectory.part.xdmf", "trajectory.xdmf"}) {
      std::ifstream file(folder / name);
      for (std::string line; std::getline(file, line);)
        if (const auto place = line.find("/frames/"); place != std::string::npos)
          groups.insert(line.substr(place, 14));
    }
    return groups.size();
  }
};

TEST_F(KillTest, LosesNoFrameAtOneOfAHundredCalls) {
  std::mt19937 random(20);  // NOLINT: the same calls each time
  for (const ShortRun& run : short_runs) {
    const long calls = count_calls(run);
    ASSERT_GT(calls, 100);
    for (int i = 0; i < 25; ++i)
      check(run, std::uniform_int_distribution<long>(1, calls)(random), static_cast<Loss>(i % 3));
  }
}

class SlowKillTest : public KillTest {};

TEST_F(SlowKillTest, LosesNoFrameAtAnyCall) {
  for (const ShortRun& run : short_runs) {
    const long calls = count_calls(run);
    for (long call = 1; call <= calls; ++call) check(run, call, static_cast<Loss>(call % 3));
  }
}

}  // namespace
}  // namespace vesica
