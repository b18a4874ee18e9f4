// `start.from`: a study that starts in the state of another one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism_draft.hpp"
#include "springfold/analysis/study.hpp"
#include "table_reader.hpp"

namespace springfold::io {

/// A point body some of whose coordinates are held in a study.
struct HoldDraft {
  Index body = 1;
  std::vector<bool> held{};          ///< per coordinate
  std::string chain{};               ///< name of the chain that holds it
  std::vector<std::string> since{};  ///< per coordinate: the study that held it first, once known
};

/// A coordinate of a point body that a study no longer holds.
struct ReleaseDraft {
  NamedPlace at{};  ///< "foot.x"
  Index body = 1;
  std::size_t coordinate = 0;
};

struct HistoryDraft {
  NamedPlace from{};  ///< name of the earlier study; empty: none
  std::string at = "end";
  bool keeps_loads = true;
  std::vector<HoldDraft> holds{};  ///< of the study itself, then with those that it takes over
  std::vector<ReleaseDraft> releases{};
  std::optional<std::size_t> study{};  ///< its position among the studies, once they are all read
};

struct StudyDraft;

/// Keys of `start` that belong to a history.
const std::vector<std::string>& history_keys();

/// @param start  the table `start` of a study
HistoryDraft read_history(const TableReader& start, const MechanismDraft& mechanism,
                          Reading& reading);

/// Finds the earlier studies by their names, and reports what cannot be a history: unknown names,
/// circles, kinds without states, different numbers of runs, springs counted from a start, releases of
/// what is not held.
void connect_histories(const MechanismDraft& mechanism, std::vector<StudyDraft>& studies,
                       Problems& problems);

}  // namespace springfold::io
