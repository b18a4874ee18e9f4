#include "verify_command.hpp"

#include <algorithm>

#include "exit_code.hpp"
#include "messages.hpp"
#include "parallel.hpp"
#include "springfold/io/read_case.hpp"
#include "springfold/io/sweep.hpp"
#include "springfold/io/verification.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using io::VerifiedCase;

bool is_case_file(const fs::path& path) {
  const std::string name = path.filename().string();
  return fs::is_regular_file(path) && name.starts_with("case") && path.extension() == ".toml";
}

/// "orthoglide-planar" for its case.toml, "orthoglide-planar/one-sided" for case-one-sided.toml.
std::string name_of(const fs::path& file) {
  const fs::path full = fs::absolute(file).lexically_normal();
  const std::string folder = full.parent_path().filename().string(), stem = full.stem().string();
  if (stem == "case") return folder;
  return folder + "/" + (stem.starts_with("case-") ? stem.substr(5) : stem);
}

/// Runs that one thread does one after the other. Those with a parameter share the formulas of
/// their case and must not be done at the same time.
struct Task {
  std::size_t of_case = 0;
  std::vector<std::size_t> runs{};
};

std::vector<Task> tasks_of(const std::vector<VerifiedCase>& cases) {
  std::vector<Task> tasks;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    Task together{c, {}};
    const auto& runs = cases[c].the_case.runs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (runs[i].family)
        together.runs.push_back(i);
      else
        tasks.push_back({c, {i}});
    }
    if (!together.runs.empty()) tasks.push_back(std::move(together));
  }
  return tasks;
}

void run_one(VerifiedCase& verified, std::size_t i, const Session& session) {
  const io::PlannedRun& planned = verified.the_case.runs[i];
  auto& result = verified.results[i];
  result = session.run_study(planned, [&](int, double) { return session.signal() == 0; });
  result.study = planned.study;
  result.run = planned.run;
  result.label = planned.label;
  if (!planned.keeps_curves) result = io::row_alone(verified.the_case, planned, result);
}

/// Every result has its own place, so that the order in which they are done does not matter.
void run_all(std::vector<VerifiedCase>& cases, int jobs, const Session& session) {
  for (VerifiedCase& verified : cases) verified.results.resize(verified.the_case.runs.size());
  const std::vector<Task> tasks = tasks_of(cases);
  in_parallel(tasks.size(), jobs, [&](std::size_t t) {
    for (const std::size_t i : tasks[t].runs)
      if (session.signal() == 0) run_one(cases[tasks[t].of_case], i, session);
  });
}

/// Reads all cases; mistakes of all of them are said.
bool load_all(const std::vector<fs::path>& files, std::vector<VerifiedCase>& cases,
              const Session& session) {
  bool all = true;
  for (const fs::path& file : files) try {
      cases.push_back({name_of(file), io::load_case(file, {}, stop_request_of(session)), {}, {}});
    } catch (const io::CaseError& error) {
      for (const auto& message : error.messages()) session.err << message << "\n";
      all = false;
    }
  return all;
}

}  // namespace

std::vector<fs::path> case_files_of(const std::vector<fs::path>& paths) {
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (is_case_file(entry.path())) inside.push_back(entry.path());
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

int verify_command(const Arguments& arguments, const Session& session) {
  std::vector<fs::path> files;
  try {
    files = case_files_of(arguments.cases);
  } catch (const fs::filesystem_error& error) {
    say(session, error.what());
    return input_output;
  }
  if (files.empty()) {
    say(session, "there is no case*.toml in these folders");
    return wrong_usage;
  }
  std::vector<VerifiedCase> cases;
  if (!load_all(files, cases, session)) {
    say(session, "nothing was run");
    return wrong_case_file;
  }
  run_all(cases, thread_count(arguments.jobs), session);
  if (const int signal = session.signal(); signal != 0) {
    say(session, "interrupted: nothing is claimed");
    return interrupted_by(signal);
  }
  for (VerifiedCase& verified : cases)
    verified.comparisons = io::compare(verified.the_case.expected, verified.results);
  session.out << (arguments.prints_json  ? io::verification_json(cases)
                  : arguments.prints_csv ? io::verification_csv(cases)
                                         : io::verification_table(cases));
  session.out.flush();
  if (!session.out.good()) {
    say(session, "cannot write to standard output");
    return input_output;
  }
  const bool all_hold =
      std::all_of(cases.begin(), cases.end(), [](const VerifiedCase& c) { return holds(c); });
  if (!all_hold) say(session, "not everything holds: see NOT OK in the table");
  return all_hold ? all_done : partial;
}

}  // namespace springfold::cli
