// How much of the curves of case files is verified: verified_arcs CASE.toml ... (continuation/verification.hpp).
// One line per study with curves, and the mean and the least share of all of them; the least is also that over curves. Also
// says what the test costs, as a multiple of the time without it.
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
  int structured = 0;
};

void add(const std::string& file, const springfold::io::PlannedRun& planned, Totals& totals) {
  using springfold::analysis::StudyKind;
  if (planned.plan.kind != StudyKind::force_deflection) return;
  run(planned, false, totals.plain);
  const StudyResult result = run(planned, true, totals.verified);
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const auto& arcs = result.branches[b].arcs;
    if (!arcs || arcs->length == 0) continue;
    if (arcs->verified == 0 && arcs->sampled.size() == 1) {
      ++totals.structured;
      continue;
    }
    totals.shares.push_back(arcs->share());
    if (arcs->share() < 0.95)
      fmt::print("{} {} run {} branch {}: {:.4f}, {} stretches\n", file, planned.study, planned.run,
                 b + 1, arcs->share(), arcs->sampled.size());
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
  double sum = 0;
  for (const double share : totals.shares) sum += share;
  if (totals.shares.empty()) return 0;
  fmt::print(
      "{} curves: mean {:.5f}, least {:.5f}; {} without any verified arc (structured, or single "
      "points)\n",
      totals.shares.size(), sum / static_cast<double>(totals.shares.size()),
      *std::min_element(totals.shares.begin(), totals.shares.end()), totals.structured);
  fmt::print("CPU: {:.2f} s without, {:.2f} s with the test: {:.2f} times\n", totals.plain,
             totals.verified, totals.verified / totals.plain);
}
