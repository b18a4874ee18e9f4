// How much of the curves of case files is verified: verified_arcs CASE.toml ... (continuation/verification.hpp). One
// line per curve below 95 %, then the mean and the least share of all curves, and what the test costs, as a multiple of
// the time without it. Curves of structured systems, which are not tested, are listed apart; curves of one point have
// no arcs. Exit code 1 where the mean is below 95 % or a curve below 80 %.
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "springfold/analysis/history.hpp"
#include "springfold/io/case_file.hpp"

namespace {

using springfold::analysis::StudyResult;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

StudyResult run(const springfold::io::PlannedRun& planned, bool verify, double& seconds) {
  springfold::analysis::Study plan = planned.plan;
  plan.trace.verify_arcs = verify;
  const double begin = cpu_seconds();
  StudyResult result = springfold::analysis::run_study_after(
      planned.history, planned.mechanism, plan, planned.family ? &*planned.family : nullptr);
  seconds += cpu_seconds() - begin;
  return result;
}

struct Totals {
  std::vector<double> shares{};    ///< of curves
  double plain = 0, verified = 0;  ///< CPU seconds
  std::vector<std::string> untested{};
};

void add(const std::string& file, const springfold::io::PlannedRun& planned, Totals& totals) {
  using springfold::analysis::StudyKind;
  if (planned.plan.kind != StudyKind::force_deflection) return;
  run(planned, false, totals.plain);
  const StudyResult result = run(planned, true, totals.verified);
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const auto& arcs = result.branches[b].arcs;
    if (!arcs || arcs->length == 0) continue;
    const std::string which =
        fmt::format("{} {} run {} branch {}", file, planned.study, planned.run, b + 1);
    if (arcs->verified == 0 && arcs->sampled.size() == 1) {
      totals.untested.push_back(which);
      continue;
    }
    totals.shares.push_back(arcs->share());
    if (arcs->share() < 0.95)
      fmt::print("{}: {:.4f}, {} stretches\n", which, arcs->share(), arcs->sampled.size());
  }
}

}  // namespace

int main(int count, char** files) {
  Totals totals;
  try {
    for (int i = 1; i < count; ++i)
      for (const auto& planned : springfold::io::load_case(files[i]).runs)
        add(files[i], planned, totals);
  } catch (const springfold::io::CaseError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
  for (const std::string& which : totals.untested)
    fmt::print("not tested, structured: {}\n", which);
  if (totals.shares.empty()) return 0;
  double sum = 0;
  for (const double share : totals.shares) sum += share;
  const double mean = sum / static_cast<double>(totals.shares.size()),
               least = *std::min_element(totals.shares.begin(), totals.shares.end());
  fmt::print("{} curves: mean {:.5f}, least {:.5f}; {} not tested\n", totals.shares.size(), mean,
             least, totals.untested.size());
  fmt::print("CPU: {:.2f} s without, {:.2f} s with the test: {:.2f} times\n", totals.plain,
             totals.verified, totals.verified / totals.plain);
  return mean < 0.95 || least < 0.8 ? 1 : 0;
}
