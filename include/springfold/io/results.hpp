// Branch tables, events, summary and manifest on disk. Data dictionary: docs/results.md.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// One compared value of the expectations.
struct Comparison {
  ExpectedValue expected{};
  double ours = 0;  ///< NaN: the run or the point does not exist
  bool holds = false;
  bool is_interrupted = false;  ///< its run did not come to its end: nothing is known of it
};

std::vector<Comparison> compare(const Expectations& expected,
                                const std::vector<analysis::StudyResult>& results);

/// The comparisons (grouped) and the notes as a text table; empty when nothing is expected.
std::string comparison_table(const std::vector<Comparison>& comparisons,
                             const Expectations& expected);

/// What happened in every run, in words only: the lines with which the blocks of summary_table begin.
std::string outline_text(const Case& the_case, const std::vector<analysis::StudyResult>& results);

/// The refused and cut steps of all runs, with their reasons.
std::string steps_table(const std::vector<analysis::StudyResult>& results);

/// A readable table of all runs: start point, stiffness, special points, stop reasons.
std::string summary_table(const Case& the_case, const std::vector<analysis::StudyResult>& results);

/// summary.json as text: schema version, runs, events, stop reasons. Same bytes for the same case.
std::string summary_json(const Case& the_case, const std::vector<analysis::StudyResult>& results);

/// What a manifest says of its files.
enum class SetState {
  being_written,  ///< files may be missing or of an earlier run: also what a killed program leaves
  interrupted,    ///< all files that it lists are there; some runs were interrupted or not begun
  whole,          ///< all files are there, and all runs were done
};

/// When results are not waited for any longer.
struct Deadline {
  std::function<bool()> is_over{};  ///< asked in tables after every block of rows; may be empty
  std::vector<std::string>
      unwritten{};  ///< filled in: tables that were left out, "branches/push-1.csv"
};

/// Writes branch CSVs, events.csv, steps.csv, summary.json, manifest.json and timings.json, each to
/// a temporary name first, then renamed; returns the files written.
/// @param state  what the manifest says at the end: being_written if figures follow
/// @param with_report  write report.html too; needs has_report()
/// @param deadline  once it is over, tables of branches that are not written yet are left out, the largest first, and
///                  the report; the manifest calls them pending. nullptr: all is written
/// @throws std::filesystem::filesystem_error or std::runtime_error when something cannot be written
std::vector<std::filesystem::path> write_results(const std::filesystem::path& folder,
                                                 const Case& the_case,
                                                 const std::vector<analysis::StudyResult>& results,
                                                 SetState state = SetState::whole,
                                                 bool with_report = false,
                                                 Deadline* deadline = nullptr);

/// Says in the manifest that nothing more is written.
/// @param pending  files that were wanted and are not there, "plots/push.png"
/// @throws std::runtime_error when it cannot be written
void close_results(const std::filesystem::path& folder, SetState state,
                   const std::vector<std::string>& pending);

}  // namespace springfold::io
