#include "io/record/record_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "io/record/attributes.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io {
namespace {

/// The arrays of a frame; each must fit the number of its nodes.
class FrameReader {
 public:
  FrameReader(const hdf5::ReadableFile& file, std::string group)
      : file_(file), group_(std::move(group)), num_nodes_(file.rows(group_ + "/positions", 3)) {}

  [[nodiscard]] problem::State state() const {
    problem::State state;
    state.time = file_.number_attribute(group_, "time");
    state.damping = file_.number_attribute(group_, "damping");
    if (state.damping < 0) file_.refuse(group_ + " @damping", "must be >= 0");
    state.values.positions = vectors("positions");
    state.triangulation = triangulation();
    state.values.mean_curvature = scalar("mean_curvature");
    state.rates.positions = vectors("velocity");
    const auto size = static_cast<Eigen::Index>(num_nodes_);
    state.rates.mean_curvature = Eigen::VectorXd::Zero(size);
    if (file_.has(group_ + "/order_parameter")) {
      state.values.order_parameter = scalar("order_parameter");
      state.rates.order_parameter = file_.has(group_ + "/order_parameter_rate")
                                        ? scalar("order_parameter_rate")
                                        : Eigen::VectorXd::Zero(size);
    }
    model::PerConstraint::fields(state.values.multipliers, [&](const Field& field, auto& value) {
      value = file_.find_attribute(group_, fmt::format("multiplier_{}", field.name));
    });
    return state;
  }

 private:
  [[nodiscard]] mesh::Positions vectors(std::string_view name) const {
    const auto values = file_.numbers(fmt::format("{}/{}", group_, name), num_nodes_, 3);
    return Eigen::Map<const mesh::Positions>(values.data(), static_cast<Eigen::Index>(num_nodes_),
                                             3);
  }
  [[nodiscard]] Eigen::VectorXd scalar(std::string_view name) const {
    const auto values = file_.numbers(fmt::format("{}/{}", group_, name), num_nodes_);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(num_nodes_));
  }
  [[nodiscard]] std::shared_ptr<const mesh::Triangulation> triangulation() const {
    const std::string path = group_ + "/mesh/triangles";
    const std::size_t num_triangles = file_.rows(path, 6);
    if (num_triangles > num_nodes_)  // of a closed surface there are about N / 2
      file_.refuse(path, fmt::format("has {} rows: more than nodes", num_triangles));
    const std::vector<std::int32_t> nodes = file_.integers(path, num_triangles, 6);
    std::vector<mesh::QuadraticTriangle> triangles(num_triangles);
    for (std::size_t i = 0; i < nodes.size(); ++i) triangles[i / 6][i % 6] = nodes[i];
    try {
      return std::make_shared<const mesh::Triangulation>(std::move(triangles),
                                                         static_cast<mesh::NodeIndex>(num_nodes_));
    } catch (const ConfigError& error) {
      file_.refuse(path, error.what());
    }
  }

  const hdf5::ReadableFile& file_;
  std::string group_;
  std::size_t num_nodes_;
};

/// A whole number that is not negative.
long whole_attribute(const hdf5::ReadableFile& file, const std::string& object,
                     const std::string& name) {
  const double value = file.number_attribute(object, name);
  if (value < 0 || value > 1e15 || value != static_cast<double>(static_cast<long>(value)))
    file.refuse(fmt::format("{} @{}", object, name), "must be a whole number >= 0");
  return static_cast<long>(value);
}

}  // namespace

std::string numbered(std::string_view group, std::size_t index) {
  return fmt::format("/{}/{:06}", group, index);
}

RecordReader::RecordReader(const std::filesystem::path& path)
    : file_(path), num_frames_(file_.count("/frames")) {
  if (num_frames_ == 0) file_.refuse("/frames", "is empty");
}

std::string RecordReader::run() const {
  return file_.has_attribute("/", "run") ? file_.text_attribute("/", "run") : "";
}

std::string RecordReader::configuration() const { return file_.text("/configuration/toml"); }

bool RecordReader::has_xdmf() const {
  return file_.number_attribute("/configuration/output", "paraview") != 0;
}

std::optional<std::string> RecordReader::verdict() const {
  if (!file_.has("/outcome") || !file_.has("/outcome/verdict")) return std::nullopt;
  return file_.text("/outcome/verdict");
}

/// The exit status of an interrupted run is 128 + signal.
int RecordReader::signal() const {
  return static_cast<int>(whole_attribute(file_, "/outcome", "exit_status") - 128);
}

setup::Origin RecordReader::origin() const {
  const std::string group = "/origin";
  if (!file_.has(group)) file_.refuse(group, "is missing: an older version wrote the file");
  setup::Origin origin;
  model::Measures::fields(origin.measures, [&](const Field& field, auto& value) {
    value = file_.find_attribute(group, std::string(field.name));
    if (!value && field.name != model::PhaseDifference::key)
      file_.refuse(fmt::format("{}@{}", group, field.name), "is missing");
  });
  origin.is_sphere = file_.number_attribute(group, "is_sphere") != 0;
  return origin;
}

compare::EnergyHistory RecordReader::history() const {
  const std::size_t rows = file_.rows("/series/step");
  return {file_.numbers("/series/step", rows), file_.numbers("/series/seconds_processor", rows),
          file_.numbers_or_nan("/series/energy_total", rows)};
}

RecordFrame RecordReader::frame(std::size_t index) const {
  const std::string group = numbered("frames", index);
  return {index,
          FrameReader(file_, group).state(),
          file_.find_attribute(group, "step_size").value_or(0),
          {}};
}

RecordFrame RecordReader::last_good() const {
  std::string damage;
  for (std::size_t index = num_frames_; index-- > 0;) {
    try {
      RecordFrame frame = this->frame(index);
      if (!damage.empty()) {
        frame.warning = fmt::format("{}; frame {} at t = {:g} is the last one that can be read",
                                    damage, index, frame.state.time);
      }
      return frame;
    } catch (const IoError& error) {
      if (damage.empty()) damage = error.what();
    }
  }
  throw IoError(damage + "; nor can any frame before it");
}

std::vector<XdmfFrame> RecordReader::frames(std::size_t count) const {
  std::vector<XdmfFrame> frames;
  for (std::size_t index = 0; index < count; ++index) {
    const std::string group = numbered("frames", index);
    const std::string mesh = file_.text_attribute(group, "mesh");
    frames.push_back({file_.number_attribute(group, "time"), group, mesh,
                      static_cast<std::int64_t>(file_.rows(group + "/positions", 3)),
                      static_cast<std::int64_t>(file_.rows(mesh + "/triangles", 6)),
                      file_.has(group + "/order_parameter"),
                      whole_attribute(file_, group, "step")});
  }
  return frames;
}

RecordEnd RecordReader::end(std::size_t num_frames) const {
  RecordEnd end;
  end.frames = frames(num_frames);
  end.step = end.frames.back().step;
  while (end.num_meshes < file_.count("/meshes") &&
         numbered("meshes", end.num_meshes) <= end.frames.back().mesh)
    ++end.num_meshes;
  if (file_.has("/series/step")) read_series(end);
  end.domain_columns = file_.names("/domains");
  if (file_.has("/domains/frame")) {
    const auto frames_of_rows = file_.numbers("/domains/frame", file_.rows("/domains/frame"));
    end.num_domain_rows = static_cast<std::size_t>(
        std::count_if(frames_of_rows.begin(), frames_of_rows.end(),
                      [&](double frame) { return frame < static_cast<double>(num_frames); }));
  }
  read_events(end);
  return end;
}

/// Rows up to the step of the last frame; counts and seconds are those of the last row.
void RecordReader::read_series(RecordEnd& end) const {
  const std::size_t all_rows = file_.rows("/series/step");
  const auto column = [&](std::string_view prefix, std::string_view name) {
    return file_.numbers(fmt::format("/series/{}{}", prefix, name), all_rows);
  };
  const std::vector<double> steps = column("", "step");
  end.num_rows =
      static_cast<std::size_t>(std::count_if(steps.begin(), steps.end(), [&](double step) {
        return step <= static_cast<double>(end.step);
      }));
  end.columns = file_.names("/series");
  if (end.num_rows == 0) return;
  const std::size_t last = end.num_rows - 1;
  solve::StepReport& report = end.outcome.report;
  solve::SolverCounts::fields(report.counts, [&](const Field& field, long& count) {
    count = static_cast<long>(column("", field.name == "steps" ? "step" : field.name)[last]);
  });
  solve::SolverSeconds::fields(report.seconds, [&](const Field& field, double& seconds) {
    seconds = column("seconds_", field.name)[last];
  });
  const auto quality = column("", "quality");
  end.outcome.initial_quality = quality.front();
  end.outcome.smallest_quality = *std::min_element(
      quality.begin(), quality.begin() + static_cast<std::ptrdiff_t>(end.num_rows));
}

void RecordReader::read_events(RecordEnd& end) const {
  for (std::size_t index = 0; index < end.num_meshes; ++index) {
    const std::string group = numbered("meshes", index);
    if (!file_.has_attribute(group, "reason")) continue;
    relax::MeshChange::fields(end.outcome.mesh_changes.emplace_back(),
                              AttributeReader(file_, group));
  }
  for (std::size_t index = 0; index < file_.count("/events"); ++index) {
    relax::Event event;
    relax::Event::fields(event, AttributeReader(file_, numbered("events", index)));
    if (event.step > end.step) break;
    end.outcome.events.push_back(std::move(event));
  }
}

}  // namespace vesica::io
