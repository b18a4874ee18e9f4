// The HTML page of every case: positions in it are those of the forward kinematics, row by row.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/report_data.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/postures.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using analysis::StudyKind;
using Json = nlohmann::json;

std::vector<fs::path> cases_with_pages() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(SPRINGFOLD_SOURCE_DIR "/cases"))
    if (const std::string name = entry.path().filename().string();
        name.starts_with("case") && name.ends_with(".toml"))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The same study with a few rows; nothing for kinds that need their whole curve.
std::optional<PlannedRun> shortened(PlannedRun run) {
  constexpr int few = 4;
  if (analysis::is_of_critical_points(run.plan.kind) || run.run > 1) return std::nullopt;
  run.plan.trace.maximum_points = few;
  run.plan.trace.spacing = 0;
  run.plan.branches = {};
  run.plan.snap.reset();
  run.plan.search.starts = few;
  run.plan.map.critical.reset();
  for (analysis::MapAxis& axis : run.plan.map.axes) axis.points = std::min(axis.points, few);
  return run;
}

std::vector<double> numbers_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0, bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    word = word << 6U | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 0xffU);
  }
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
  return numbers;
}

double number_at(const Json& run, const std::vector<double>& row, const std::string& name) {
  for (std::size_t i = 0; i < run["quantities"].size(); ++i)
    if (run["quantities"][i]["name"] == name) return row[i];
  return std::numeric_limits<double>::quiet_NaN();
}

using Place = model::Vec3<double>;

/// The parts of a row; nullptr where it has no posture.
const Json* parts_of_row(const Json& run, const Json& list, std::size_t row) {
  const int layout = list["layout"].is_null() ? 0 : list["layout"][row].get<int>();
  return layout < 0 ? nullptr : &run["mechanisms"][static_cast<std::size_t>(layout)];
}

/// Points of a row of a list, as they stand in the page; none where the row has no posture.
std::vector<Place> points_in(const Json& run, const Json& list, const std::vector<double>& all,
                             std::size_t row) {
  std::size_t first = 0, d = 0, count = 0;
  for (std::size_t i = 0; i <= row; ++i) {
    first += d * count;
    const Json* parts = parts_of_row(run, list, i);
    d = parts == nullptr ? 0 : (*parts)["dimension"].get<std::size_t>();
    count = parts == nullptr ? 0 : (*parts)["points"].get<std::size_t>();
  }
  std::vector<Place> points(count, Place::Zero());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < d; ++k) points[i][static_cast<Index>(k)] = all[first + d * i + k];
  return points;
}

struct Counts {
  std::size_t rows = 0, bodies = 0, points = 0;
};

/// Bodies and named points stand where the row's columns say. The columns come from the statics, the points from the
/// drawing: two paths.
void expect_columns(const Json& run, const Json& mechanism, const std::vector<double>& row,
                    const std::vector<Place>& points, double size, const std::string& where,
                    Counts& counts) {
  for (const char* list : {"bodies", "names"})
    for (const Json& part : mechanism[list]) {
      const auto at = part[std::string{list} == "bodies" ? "origin" : "at"].get<std::size_t>();
      ++(std::string{list} == "bodies" ? counts.bodies : counts.points);
      for (Index axis = 0; axis < 3; ++axis) {
        const std::string name = part["name"].get<std::string>() + "." + "xyz"[axis];
        const double value = number_at(run, row, name);
        if (!std::isfinite(value)) continue;
        EXPECT_NEAR(points[at][axis], value, 1e-9 * size) << where << " " << name;
      }
    }
}

void expect_places(const Json& run, const PlannedRun& planned, const analysis::StudyResult& result,
                   const std::string& where, Counts& counts) {
  const RowScenes scenes{planned, result};
  if (!scenes.has_postures()) return;
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const Json& list = run["branches"][b];
    const auto values = numbers_of(list["values"]), all = numbers_of(list["points"]);
    const std::size_t width = result.quantities.size();
    ASSERT_EQ(list["rows"], result.branches[b].samples.size()) << where;
    for (std::size_t row = 0; row < result.branches[b].samples.size(); ++row) {
      const auto scene = scenes.scene_of(result.branches[b].samples[row]);
      const auto points = points_in(run, list, all, row);
      if (!scene) {
        EXPECT_TRUE(points.empty()) << where;
        continue;
      }
      const Json* parts = parts_of_row(run, list, row);
      ASSERT_NE(parts, nullptr) << where;
      const Json& mechanism = *parts;
      ++counts.rows;
      const double size = drawing::size_of(*scene);
      // The chains, joint by joint, end where their bodies are.
      EXPECT_LT(drawing::largest_gap(*scene), 1e-9) << where << " row " << row;
      ASSERT_EQ(points.size(), scene->points.size()) << where;
      const Index d = mechanism["dimension"].get<Index>();
      for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(points[i].head(d), scene->points[i].head(d)) << where << " row " << row;
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * width);
      expect_columns(run, mechanism, {first, first + static_cast<std::ptrdiff_t>(width)}, points,
                     size, where + " row " + std::to_string(row), counts);
    }
  }
}

TEST(Page, EveryCaseHasThePositionsOfTheForwardKinematicsInEveryRow) {
  Counts counts;
  std::size_t pages = 0;
  for (const fs::path& file : cases_with_pages()) {
    Case the_case = load_case(file);
    std::vector<PlannedRun> runs;
    for (const PlannedRun& run : the_case.runs)
      if (auto few_rows = shortened(run)) runs.push_back(std::move(*few_rows));
    the_case.runs = runs;
    std::vector<analysis::StudyResult> results;
    for (const PlannedRun& run : runs) {
      results.push_back(analysis::run_study_after(run.history, run.mechanism, run.plan,
                                                  run.family ? &*run.family : nullptr));
      results.back().study = run.study;
      results.back().run = run.run;
    }
    const Json page = Json::parse(report_data(the_case, results));
    ASSERT_EQ(page["runs"].size(), runs.size()) << file;
    for (std::size_t i = 0; i < runs.size(); ++i)
      expect_places(page["runs"][i], runs[i], results[i],
                    fs::relative(file, SPRINGFOLD_SOURCE_DIR).string() + " " + runs[i].study,
                    counts);
    ++pages;
  }
  EXPECT_EQ(pages, cases_with_pages().size());
  EXPECT_GT(counts.rows, 500U);
  EXPECT_GT(counts.bodies, counts.rows);
  EXPECT_GT(counts.points, 0U);
}

}  // namespace
}  // namespace springfold::io
