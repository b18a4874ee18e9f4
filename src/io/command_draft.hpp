// What studies of the kinds control, map and workspace say, their numbers still formulas.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "numbers.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::io {

struct CircleDraft {
  std::vector<NumberId> centre{};
  NumberId radius = 0, from = 0, to = 0, points = 0;
  Index first = 0, second = 1;
};
struct LineDraft {
  std::vector<NumberId> from{}, to{};
  NumberId points = 0;
};
struct MapAxisDraft {
  std::string name{};
  std::optional<Index> pose{};
  std::optional<std::size_t> parameter{};
  NumberId from = 0, to = 0, points = 0;
};
struct CriticalDraft {
  std::vector<NumberId> direction{};
  NumberId up_to = 0;
};
/// A table of targets in a file of its own.
struct TargetFile {
  std::string name{};
  Place place{};
  std::string key{};
  std::vector<std::string> coordinates{};  ///< columns that it must have
  std::vector<std::string> wrench{};       ///< columns that it may have
};

struct CommandDraft {
  std::vector<Index> prescribed{};
  std::vector<std::string> commands{};
  analysis::CommandMethod method = analysis::CommandMethod::newton;
  // control
  std::vector<std::vector<NumberId>> targets{}, loads{};
  std::optional<LineDraft> line{};
  std::optional<CircleDraft> circle{};
  std::optional<TargetFile> file{};
  // map
  std::vector<MapAxisDraft> axes{};
  analysis::NodeCommand command = analysis::NodeCommand::kinetostatic;
  std::vector<NumberId> pose{};
  std::vector<std::vector<NumberId>> directions{};
  std::optional<CriticalDraft> critical{};
  // workspace
  analysis::RegionShape shape = analysis::RegionShape::square;
  std::vector<NumberId> centre{};
  std::vector<NumberId> velocity{}, force{};  ///< [low, high] or none
  std::optional<NumberId> up_to{};
};

/// Unit length of the translational part, or of the rotational part if the first is zero.
Vector normalised(const Vector& v, model::TaskSpace space);

/// Fills in what the study has beside the keys of all studies. @param numbers  of the study
void build_commands(const CommandDraft& draft, model::TaskSpace space,
                    const std::vector<double>& numbers, analysis::Study& study);

}  // namespace springfold::io
