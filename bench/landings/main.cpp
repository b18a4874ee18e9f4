// Do jumps land where they should by four ways that know nothing of each other? Random mechanisms, all jumps that are
// called unambiguous: the landing on the traced diagram, the overdamped motion by CVODE, the same motion by
// Boost.Odeint, and the motion with masses at strong damping. And is what the dampers take what is released?
//
//     build/release/bench/landings [jumps] [mechanisms] [seed] [only]
//
// So many jumps of so many mechanisms, the same number of each: 100 of 20 if nothing is given. `only`: the one
// mechanism that is looked at, by the number that is printed.
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "analysis/branches.hpp"
#include "analysis/fall.hpp"
#include "analysis/inertia.hpp"
#include "analysis/run_traced.hpp"
#include "analysis/snap_jumps.hpp"
#include "random_mechanism.hpp"

namespace springfold::analysis {
namespace {

namespace odeint = boost::numeric::odeint;
using State = std::vector<double>;

struct Tally {
  int jumps = 0, ambiguous = 0, on_diagram = 0, cvode = 0, explicit_ = 0, masses = 0, balanced = 0;
  double largest_gap = 0;  ///< of dissipated and released energy, relative

  void add(const Tally& other) {
    jumps += other.jumps;
    ambiguous += other.ambiguous;
    on_diagram += other.on_diagram;
    cvode += other.cvode;
    explicit_ += other.explicit_;
    masses += other.masses;
    balanced += other.balanced;
    largest_gap = std::max(largest_gap, other.largest_gap);
  }
  bool all_agree() const {
    return on_diagram == jumps && cvode == jumps && explicit_ == jumps && masses == jumps &&
           balanced == jumps;
  }
  void print() const {
    std::printf(
        "  %d jumps (%d more depend on damping and masses)\n"
        "  landing on the diagram %d, by CVODE %d, by Odeint %d, with masses %d\n"
        "  energies balanced to 1e-6: %d, largest gap %.1e\n",
        jumps, ambiguous, on_diagram, cvode, explicit_, masses, balanced, largest_gap);
  }
};

struct Ended {
  std::optional<RestState> state{};
  double dissipated = 0;
};

/// The overdamped motion by an explicit method with dense output; the last entry is the work of the dampers.
Ended by_odeint(const Landscape& landscape, const Vector& from) {
  const Motion motion{landscape};
  const auto& moving = landscape.moving();
  Vector x = from;
  const auto n = moving.size();
  const auto put = [&](const State& s) {
    for (std::size_t i = 0; i < n; ++i) x[moving[i]] = s[i];
  };
  const auto rate = [&](const State& s, State& ds, double) {
    put(s);
    ds.assign(n + 1, std::numeric_limits<double>::quiet_NaN());
    const auto piece = landscape.piece_at(x);
    const auto found = piece ? overdamped_rate(motion, x, *piece) : std::nullopt;
    if (!found) return;
    std::copy(found->rate.begin(), found->rate.end(), ds.begin());
    ds[n] = found->power;
  };
  State s(n + 1, 0.0), ds;
  for (std::size_t i = 0; i < n; ++i) s[i] = from[moving[i]];
  auto stepper = odeint::make_dense_output(1e-9, 1e-9, odeint::runge_kutta_dopri5<State>());
  stepper.initialize(s, 0.0, 1e-3);
  constexpr int most = 1000000;
  constexpr double nearly_at_rest = 1e-7;
  for (int k = 0; k < most; ++k) {
    stepper.do_step(rate);
    s = stepper.current_state();
    rate(s, ds, 0);
    double speed = 0;
    for (std::size_t i = 0; i < n; ++i) speed = std::max(speed, std::abs(ds[i]));
    if (!(speed < nearly_at_rest)) continue;
    put(s);
    const auto state = rest_near(landscape, x);
    if (state && is_minimum(*state))
      return {state, s[n] + std::max(0.0, landscape.energy(x) - state->energy)};
  }
  return {};
}

class Comparison {
 public:
  Comparison(const Tracing& t, const Scales& scales, Tally& tally, int most)
      : t_{t}, scales_{scales}, tally_{tally}, most_{most} {}

  /// @param number  of this jump among those from the same special point
  void compare(const Jump& jump, std::size_t number) {
    if (tally_.jumps >= most_) return;
    if (jump.verdict != SnapVerdict::unambiguous) {
      ++tally_.ambiguous;
      return;
    }
    ++tally_.jumps;
    const Index size = t_.problem.layout().size;
    const double lambda = jump.critical.values[column_of(Kind::lambda, t_.quantities)];
    const Frozen frozen(t_.problem, scales_, lambda / t_.lambda_scale, {});
    const Landscape& landscape = frozen.landscape();
    Vector critical = frozen.reduced(unknowns_in(jump.critical.values, t_.quantities, size));
    landscape.close(critical);
    const Departures ways = departures(landscape, critical, landscape.pieces_beside(critical));
    if (number >= ways.list.size()) return;
    const Vector from = ways.list[number].x;
    const auto landing =
        rest_near(landscape, frozen.reduced(unknowns_in(jump.landing.values, t_.quantities, size)));
    if (!landing) return;
    tally_.on_diagram += jump.landing.branch > 0 ? 1 : 0;
    const double released = landscape.energy(from) - landing->energy;
    bool balanced = true;
    const auto count = [&](const std::optional<RestState>& state, double dissipated, int& hits) {
      const bool same = state && landscape.same(state->x, landing->x);
      hits += same ? 1 : 0;
      const double gap = std::abs(dissipated - released) / released;
      balanced = balanced && gap <= 1e-6;
      if (same) tally_.largest_gap = std::max(tally_.largest_gap, gap);
    };
    const Flow flow = flow_by_cvode({landscape}, from);
    count(flow.end == Flow::End::rest ? std::optional(flow.state) : std::nullopt, flow.dissipated,
          tally_.cvode);
    const Ended second = by_odeint(landscape, from);
    count(second.state, second.dissipated, tally_.explicit_);
    constexpr double strong = 4;
    const Inertial inertial =
        inertial_motion(frozen, scales_, {.damping_ratio = strong}, from, &*landing);
    count(inertial.landing, inertial.motion.dissipated / scales_.moment(), tally_.masses);
    if (!balanced)
      std::printf("  jump from %s at %.6g: masses end %s\n", jump.from.c_str(), lambda,
                  !inertial.landing                                 ? "nowhere"
                  : landscape.same(inertial.landing->x, landing->x) ? "at the landing"
                                                                    : "elsewhere");
    tally_.balanced += balanced ? 1 : 0;
  }

 private:
  using Kind = QuantityDefinition::Kind;
  const Tracing& t_;
  const Scales& scales_;
  Tally& tally_;
  int most_;
};

void compare_all(const bench::Draw& draw, Tally& tally, int most) {
  Study study = draw.study;
  study.branches.depth = 1;
  const SnapResult found = run_with_jumps(draw.mechanism, study);
  run_from_start(draw.mechanism, study, nullptr, {},
                 [&](const Tracing& tracing, const Scales& scales, const continuation::CurvePoint&,
                     StudyResult&) {
                   Comparison comparison(tracing, scales, tally, most);
                   std::map<std::pair<std::string, int>, std::size_t> numbers;
                   for (const Jump& jump : found.report.jumps)
                     comparison.compare(jump, numbers[{jump.from, jump.loading}]++);
                 });
}

}  // namespace
}  // namespace springfold::analysis

/// Mechanisms are drawn until as many as are wanted give their share of the jumps. All that are drawn are compared;
/// those with fewer jumps are counted apart, and do not decide the exit code: it is 0 if all jumps that were asked for
/// agree.
int main(int argc, char** argv) {
  using namespace springfold;
  const auto number = [&](int i, int otherwise) {
    return argc > i ? static_cast<int>(std::strtol(argv[i], nullptr, 10)) : otherwise;
  };
  const int jumps = number(1, 100), mechanisms = number(2, 20);
  std::mt19937_64 random(static_cast<unsigned>(number(3, 1)));
  const int only = number(4, 0);
  const int each = (jumps + mechanisms - 1) / mechanisms;
  const int most = 50 * mechanisms;
  analysis::Tally counted, apart;
  int full = 0, drawn = 0;
  for (; full < mechanisms && drawn < most; ++drawn) {
    const bench::Draw draw =
        drawn % 4 == 0
            ? bench::random_truss(random)
            : bench::row_of(bench::random_units(random, 2 + drawn % 3), drawn % 4 == 1 ? 0 : 0.02);
    if (only > 0 && drawn + 1 != only) {
      if (drawn + 1 > only) break;
      continue;
    }
    analysis::Tally own;
    analysis::compare_all(draw, own, each);
    const bool is_full = own.jumps == each;
    full += is_full ? 1 : 0;
    (is_full ? counted : apart).add(own);
    std::printf("mechanism %d: %d jumps%s\n", drawn + 1, own.jumps,
                own.all_agree() ? "" : ", NOT THE SAME BY ALL WAYS");
    std::fflush(stdout);
  }
  std::printf("%d mechanisms of %d with %d jumps each:\n", full, drawn, each);
  counted.print();
  std::printf("the other %d:\n", drawn - full);
  apart.print();
  return full == mechanisms && counted.all_agree() ? EXIT_SUCCESS : EXIT_FAILURE;
}
