// Study kind `map`: a grid of nodes on all cores. A row of nodes along the first axis is one piece
// of work: within it plain inverse kinematics is carried from node to node, so that nothing depends
// on how many threads there are.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <ctime>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>

#include "analysis/undefined.hpp"
#include "branch_rows.hpp"
#include "critical_load.hpp"
#include "grow_diagram.hpp"
#include "node_state.hpp"
#include "run_kinds.hpp"

namespace springfold::analysis {

double MapAxis::at(int i) const {
  const int last = points - 1;
  return last == 0 ? from : (from * (last - i) + to * i) / last;
}

int MapSettings::nodes() const {
  int count = 1;
  for (const MapAxis& axis : axes) count *= axis.points;
  return count;
}

namespace {

/// A mechanism, and where its plain inverse kinematics begins.
struct MapGround {
  CommandSetup setup{};
  statics::KinematicInverse own{};
};

MapGround ground_of(const model::Mechanism& mechanism, const Study& study, const Vector& load) {
  MapGround ground{command_setup(mechanism, study, load), {}};
  ground.own = at_own_pose(ground.setup);
  return ground;
}

/// Computes nodes; immutable, shared by all threads.
class NodeMaker {
 public:
  NodeMaker(const model::Mechanism& mechanism, const Study& study, std::size_t columns)
      : study_{study}, columns_{columns} {
    for (const MapAxis& axis : study.map.axes) varies_ |= !axis.pose.has_value();
    if (!varies_) ground_ = ground_of(mechanism, study, study.constant_load);
  }

  /// The nodes of one row, numbered along the first axis; `stop` ends it early.
  std::vector<Sample> row(int number, const std::atomic<bool>& stop) const {
    const int count = study_.map.axes.front().points;
    std::vector<Sample> samples;
    statics::KinematicInverse near = varies_ ? statics::KinematicInverse{} : ground_.own;
    for (int i = 0; i < count && !stop; ++i) samples.push_back(node(number * count + i, near));
    return samples;
  }

 private:
  /// @param near  a closed state of plain inverse kinematics nearby, replaced by that of this node
  Sample node(int number, statics::KinematicInverse& near) const {
    std::vector<double> at, parameters;
    Vector pose = study_.map.pose;
    if (pose.size() == 0 && !varies_)
      pose = ground_.setup.pose.cwiseProduct(ground_.setup.pose_scale);
    for (const MapAxis& axis : study_.map.axes) {
      at.push_back(axis.at(number % axis.points));
      number /= axis.points;
      if (!axis.pose) parameters.push_back(at.back());
    }
    MapGround own;
    if (varies_) {
      const Situation situation = study_.map.situation(parameters);
      if (!situation.problem.empty()) return without_values(at, "no start: " + situation.problem);
      if (const auto mistakes = model::problems_in(situation.mechanism); !mistakes.empty())
        return without_values(at, "no mechanism: " + mistakes.front());
      own = ground_of(situation.mechanism, study_, situation.constant_load);
      near = own.own;
      pose = situation.pose;
      if (pose.size() == 0) pose = own.setup.pose.cwiseProduct(own.setup.pose_scale);
    }
    for (std::size_t a = 0; a < at.size(); ++a)
      if (study_.map.axes[a].pose) pose[*study_.map.axes[a].pose] = at[a];
    Sample sample{.values = at};
    fill(varies_ ? own.setup : ground_.setup, pose, near, sample);
    sample.values.resize(columns_, undefined);
    return sample;
  }

  Sample without_values(const std::vector<double>& at, std::string status) const {
    Sample sample{.values = at, .state = NodeState::outside};
    sample.values.resize(columns_, undefined);
    sample.status = std::move(status);
    return sample;
  }

  void fill(const CommandSetup& setup, const Vector& pose, statics::KinematicInverse& near,
            Sample& sample) const {
    CommandedState state;
    const NotHeld failed = solve_node(study_, setup, pose, near, state);
    if (!failed.why.empty()) {
      sample.status = failed.is_shown ? words(failed) : "undecided: " + failed.why;
      sample.state = failed.is_shown ? NodeState::outside : NodeState::undecided;
      return;
    }
    const CommandedValues at = command_values(setup, study_.map.directions, state);
    sample.values.insert(sample.values.end(), at.values.begin(), at.values.end());
    sample.piece = piece_text(setup.system, state.piece);
    sample.status = status_of(at);
    sample.state = state_of(at);
    if (!study_.map.critical) return;
    if (sample.state != NodeState::stable) {
      sample.values.push_back(undefined);
      return;
    }
    const CriticalLoad critical =
        critical_load(setup, state, *study_.map.critical, options_of(study_.trace));
    sample.values.push_back(critical.load);
    if (critical.why.empty()) return;
    sample.status = "critical load not found: " + critical.why;
    sample.state = NodeState::load_not_found;
  }

  const Study& study_;
  std::size_t columns_ = 0;
  bool varies_ = false;  ///< an axis is a parameter: every node has its own mechanism
  MapGround ground_{};   ///< otherwise: of all nodes
};

/// Rows that threads take one after the other.
class Pool {
 public:
  Pool(const NodeMaker& maker, int rows, int row_length, PartialRows& all)
      : maker_{maker}, rows_{rows}, row_length_{row_length}, all_{all} {
    for (int r = 0; r < rows; ++r) {
      known_.push_back(all.done[static_cast<std::size_t>(r * row_length)]);
      left_ += known_.back() ? 0 : 1;
    }
  }

  /// Runs until all rows are done or `observe` returns false; `observe` gets the nodes done.
  void run(int threads, const std::function<bool(int)>& observe,
           const std::function<void()>& checkpoint) {
    using clock = std::chrono::steady_clock;
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(threads));
    for (int i = 0; i < threads; ++i) try {
        workers.emplace_back([this] { work(); });
      } catch (const std::system_error&) {  // as many as the system gives
        break;
      }
    if (workers.empty()) work();
    auto last = clock::now();
    std::unique_lock lock{mutex_};
    while (left_ > 0 && !failure_ && !stop_) {
      changed_.wait_for(lock, std::chrono::milliseconds{100});
      const int done = nodes_done();
      const bool save = checkpoint && clock::now() - last > std::chrono::seconds{2};
      if (save) {
        checkpoint();
        last = clock::now();
      }
      lock.unlock();
      if (observe && !observe(done)) stop_ = true;
      lock.lock();
    }
    stop_ = true;
    lock.unlock();
    workers.clear();  // joins
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  int nodes_done() const { return (rows_ - left_) * row_length_; }

  void work() {
    try {
      while (!stop_) {
        const int row = next_++;
        if (row >= rows_) return;
        if (known_[static_cast<std::size_t>(row)]) continue;
        put(row, maker_.row(row, stop_));
      }
    } catch (...) {
      const std::lock_guard lock{mutex_};
      failure_ = std::current_exception();
    }
    changed_.notify_one();
  }

  void put(int row, std::vector<Sample> samples) {
    if (std::ssize(samples) != row_length_) return;  // stopped within the row
    const std::lock_guard lock{mutex_};
    for (int i = 0; i < row_length_; ++i) {
      const auto node = static_cast<std::size_t>(row * row_length_ + i);
      all_.rows[node] = std::move(samples[static_cast<std::size_t>(i)]);
      all_.done[node] = true;
    }
    --left_;
    if (left_ == 0) changed_.notify_one();
  }

  const NodeMaker& maker_;
  int rows_ = 0, row_length_ = 0;
  PartialRows& all_;
  std::vector<bool> known_{};  ///< rows that are done already; read only while threads run
  int left_ = 0;
  std::atomic<int> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_{};
  std::condition_variable changed_{};
  std::exception_ptr failure_{};
};

/// Rows of an earlier run, as far as whole rows of nodes are known; the others empty.
PartialRows begun(const RunOptions& options, std::size_t nodes, std::size_t row_length) {
  PartialRows all{std::vector<Sample>(nodes), std::vector<bool>(nodes, false)};
  if (options.known == nullptr || options.known->rows.size() != nodes) return all;
  for (std::size_t first = 0; first < nodes; first += row_length) {
    bool whole = true;
    for (std::size_t i = first; i < first + row_length; ++i)
      whole = whole && options.known->done[i];
    for (std::size_t i = first; whole && i < first + row_length; ++i) {
      all.rows[i] = options.known->rows[i];
      all.done[i] = true;
    }
  }
  return all;
}

void fill_missing(const Study& study, std::size_t columns, PartialRows& all) {
  for (std::size_t node = 0; node < all.rows.size(); ++node) {
    if (all.done[node]) continue;
    Sample& sample = all.rows[node];
    sample = {};
    auto number = static_cast<int>(node);
    for (const MapAxis& axis : study.map.axes) {
      sample.values.push_back(axis.at(number % axis.points));
      number /= axis.points;
    }
    sample.values.resize(columns, undefined);
    sample.status = "not computed";
    sample.state = NodeState::not_computed;
  }
}

/// How many nodes are what: the report of the map.
std::string census(const std::vector<Sample>& rows) {
  const auto number_of = [&rows](NodeState state) {
    return static_cast<int>(std::count_if(
        rows.begin(), rows.end(), [state](const Sample& row) { return row.state == state; }));
  };
  std::string text = std::to_string(number_of(NodeState::stable)) + " nodes held and stable";
  const auto add = [&text](int count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(number_of(NodeState::unstable) + number_of(NodeState::critical), "held but not stable");
  add(number_of(NodeState::outside), "outside of the workspace");
  add(number_of(NodeState::undecided), "undecided");
  add(number_of(NodeState::load_not_found), "without critical load: not found");
  add(number_of(NodeState::not_computed), "not computed");
  return text;
}

void add_doubts(StudyResult& result) {
  const auto& rows = result.branches.front().samples;
  const auto add = [&](NodeState state, const std::string& before, const std::string& after) {
    const auto count = std::count_if(rows.begin(), rows.end(),
                                     [state](const Sample& row) { return row.state == state; });
    if (count > 0) result.doubts.push_back(before + std::to_string(count) + after);
  };
  add(NodeState::load_not_found, "the critical load was not found at ", " nodes: see their status");
  add(NodeState::undecided, "no equilibrium was found at ",
      " nodes, which does not show that there is none: see their status");
}

}  // namespace

StudyResult run_map(const model::Mechanism& mechanism, const Study& study, const Observer& observer,
                    const RunOptions& options) {
  const std::clock_t began = std::clock();
  StudyResult result;
  result.study = study.name;
  result.quantities = columns_of(study, mechanism);
  const std::size_t columns = result.quantities.size();
  const int nodes = study.map.nodes(), length = study.map.axes.front().points;
  PartialRows all =
      begun(options, static_cast<std::size_t>(nodes), static_cast<std::size_t>(length));
  {
    const NodeMaker maker(mechanism, study, columns);
    Pool pool(maker, nodes / length, length, all);
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const auto observe = [&](int done) {
      return !observer || observer(done, static_cast<double>(done) / nodes);
    };
    const auto checkpoint = [&] { options.checkpoint(all); };
    pool.run(options.threads > 0 ? options.threads : cores, observe,
             options.checkpoint ? std::function<void()>(checkpoint) : std::function<void()>());
  }
  const auto missing = std::count(all.done.begin(), all.done.end(), false);
  if (missing > 0 && options.checkpoint) options.checkpoint(all);
  fill_missing(study, columns, all);
  result.start.found = true;
  result.start.method = "grid of " + std::to_string(nodes) + " nodes";
  result.start.attempts = 1;
  Branch& branch = result.branches.emplace_back();
  branch.samples = std::move(all.rows);
  branch.backward = {"first node", true};
  branch.forward = {census(branch.samples), missing == 0};
  if (missing > 0) branch.forward.reason = "interrupted: " + branch.forward.reason;
  add_doubts(result);
  result.seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace springfold::analysis
