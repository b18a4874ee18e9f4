#include "runs.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>

#include "in_time.hpp"
#include "map_runs.hpp"
#include "messages.hpp"
#include "parallel.hpp"
#include "progress.hpp"
#include "ranks.hpp"
#include "springfold/io/checkpoint.hpp"
#include "springfold/io/sweep.hpp"

namespace springfold::cli {
namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;
using io::PlannedRun;

/// Consecutive runs of one study.
struct Batch {
  std::size_t first = 0, count = 0;
};

std::vector<Batch> batches_of(const io::Case& the_case) {
  std::vector<Batch> batches;
  for (std::size_t i = 0; i < the_case.runs.size(); ++i) {
    if (i == 0 || the_case.runs[i].study != the_case.runs[i - 1].study) batches.push_back({i, 0});
    ++batches.back().count;
  }
  return batches;
}

/// Owns what it needs: threads of runs that were given up still use it.
class Runner {
 public:
  Runner(Arguments arguments, fs::path folder, std::shared_ptr<const io::Case> the_case,
         const Session& session)
      : arguments_{std::move(arguments)},
        folder_{std::move(folder)},
        owned_{std::move(the_case)},
        session_{session},
        progress_{session.err, session.shows_progress},
        found_(case_.runs.size()),
        interrupted_(case_.runs.size(), 0),
        begun_(case_.runs.size(), 0) {}

  void run() {
    for (const Batch& batch : batches_of(case_)) {
      if (session_.signal() != 0 || failed_ != nullptr) break;
      const PlannedRun& first = case_.runs[batch.first];
      // Maps use all cores for themselves.
      const bool is_map = first.plan.kind == analysis::StudyKind::map && session_.run_map;
      if (is_helper() && first.keeps_curves) continue;
      if (!first.keeps_curves) take_known(batch);
      divide(batch);
      {
        const std::scoped_lock lock{busy_};
        batch_ = batch;
        ended_ = 0;
        counting_ = false;
        written_ = {};  // the first row is put on the disk at once
        progress_.begin_runs(batch.count);
      }
      in_parallel(batch.count, is_map ? 1 : threads(),
                  [&](std::size_t i) { run_one(batch, batch.first + i, is_map); });
      if (is_divided_) bring_together(batch);
      const std::scoped_lock lock{busy_};
      if (!first.keeps_curves && !is_helper()) write_rows(batch);
    }
  }

  /// Takes what was found. What comes later, from threads that were given up, is not kept.
  Results collected() {
    const std::scoped_lock lock{busy_};
    if (!closed_ && session_.signal() != 0 && batch_.count > 0 && !is_helper() &&
        !case_.runs[batch_.first].keeps_curves)
      write_rows(batch_);
    closed_ = true;
    progress_.clear();
    Results results{.failed = failed_};
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (!found_[i]) {
        if (begun_[i] == in_work) results.given_up.push_back(&case_.runs[i]);
        continue;
      }
      results.list.push_back(std::move(*found_[i]));
      results.interrupted.push_back(interrupted_[i] != 0);
    }
    return results;
  }

 private:
  /// Rows of an earlier run that was interrupted.
  void take_known(const Batch& batch) {
    if (!arguments_.resumes || is_helper()) return;
    const std::string& study = case_.runs[batch.first].study;
    auto known = io::read_row_checkpoint(folder_, case_, study);
    for (std::size_t i = batch.first; i < batch.first + batch.count; ++i)
      if (const auto at = known.find(case_.runs[i].run); at != known.end())
        found_[i] = std::move(at->second);
    if (known.empty()) return;
    progress_.clear();
    say(session_.err, study + ": " + std::to_string(known.size()) + " of " +
                          std::to_string(batch.count) + " runs are known already");
  }

  void run_one(const Batch& batch, std::size_t i, bool is_map) {
    const PlannedRun& planned = case_.runs[i];
    if (elsewhere_[i] != 0 || found_[i] || session_.signal() != 0 || is_over()) return;
    const std::string number =
        std::to_string(i + 1) + "/" + std::to_string(case_.runs.size()) + " " + planned.study;
    {
      const std::scoped_lock lock{busy_};
      begun_[i] = in_work;
      const bool counts = is_counted(batch, is_map);
      if (counts && !counting_)
        progress_.begin(planned.study + ", " + std::to_string(batch.count) + " runs");
      else if (!counts)
        progress_.begin(planned.label.empty() ? number : number + ", " + planned.label);
      counting_ = counts;
    }
    try {
      keep(batch, i, computed(planned, is_map));
    } catch (const std::bad_alloc&) {
      fail(planned);
    } catch (const std::length_error&) {
      fail(planned);
    }
    const std::scoped_lock lock{busy_};
    begun_[i] = has_ended;
    ++ended_;
    progress_.end_run();
    if (is_counted(batch, is_map) && !closed_)
      progress_.part(static_cast<double>(ended_) / static_cast<double>(batch.count));
  }

  /// Of many runs it is shown how many are done and how long the others will take, not each. Maps show
  /// their own.
  static bool is_counted(const Batch& batch, bool is_map) {
    constexpr std::size_t many = 8;
    return !is_map && batch.count >= many;
  }

  /// Points that a curve may have, both ways; 0 where there may be more branches or stages.
  static int most_points(const PlannedRun& planned) {
    const analysis::Study& plan = planned.plan;
    const bool is_one_curve = plan.kind == analysis::StudyKind::force_deflection &&
                              plan.branches.depth == 0 && plan.branches.search_at.empty() &&
                              !plan.snap;
    return is_one_curve ? 2 * plan.trace.maximum_points : 0;
  }

  StudyResult computed(const PlannedRun& planned, bool is_map) {
    StudyResult result = is_map ? run_map(arguments_, folder_, case_, planned, session_, progress_)
                                : session_.run_study(planned, [this, &planned](int points, double) {
                                    if (session_.signal() != 0) return false;
                                    const std::scoped_lock lock{busy_};
                                    if (!closed_ && !counting_)
                                      progress_.points(points, most_points(planned));
                                    return true;
                                  });
    result.study = planned.study;
    result.run = planned.run;
    result.label = planned.label;
    return result;
  }

  void keep(const Batch& batch, std::size_t i, StudyResult result) {
    const PlannedRun& planned = case_.runs[i];
    const bool ended = session_.signal() != 0 && !analysis::complete(result);
    if (!planned.keeps_curves) {
      if (ended) return;
      result = io::row_alone(case_, planned, result);
    }
    const std::scoped_lock lock{busy_};
    if (closed_) return;
    interrupted_[i] = ended ? 1 : 0;
    if (is_helper()) return session_.ranks->send(io::row_line(result));
    found_[i] = std::move(result);
    if (is_divided_) receive(batch);
    if (!planned.keeps_curves) write_rows_now_and_then(batch);
  }

  /// Under the lock.
  void write_rows_now_and_then(const Batch& batch) {
    constexpr std::chrono::seconds between_checkpoints{2};
    const auto now = std::chrono::steady_clock::now();
    if (now - written_ < between_checkpoints) return;
    write_rows(batch);
    written_ = now;
  }

  bool is_helper() const { return session_.ranks != nullptr && session_.ranks->number() > 0; }

  /// Several processes share the cores: one thread each unless it is said.
  int threads() const {
    const bool several = session_.ranks != nullptr && session_.ranks->are_several();
    return several ? std::max(arguments_.threads, 1) : thread_count(arguments_.threads);
  }

  /// Which runs of a sweep other processes do: those that are not known yet, in turn.
  void divide(const Batch& batch) {
    is_divided_ = session_.ranks != nullptr && session_.ranks->are_several() &&
                  !case_.runs[batch.first].keeps_curves;
    elsewhere_.assign(case_.runs.size(), 0);
    if (!is_divided_) return;
    std::vector<char> known(batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) known[i] = found_[batch.first + i] ? 1 : 0;
    session_.ranks->share(known);
    int turn = 0;
    for (std::size_t i = 0; i < batch.count; ++i) {
      const bool mine =
          known[i] == 0 && turn++ % session_.ranks->count() == session_.ranks->number();
      elsewhere_[batch.first + i] = mine ? 0 : 1;
    }
    ends_ = 0;
  }

  /// Rows of other processes that have arrived, under the lock.
  void receive(const Batch& batch) {
    const std::string& study = case_.runs[batch.first].study;
    ends_ += session_.ranks->receive([&](const std::string& line) {
      auto result = io::read_row_line(line, case_, study);
      if (!result) {  // its number alone: there was not enough memory for it
        fail_locked(case_.runs[batch.first + static_cast<std::size_t>(std::stoul(line))]);
        return;
      }
      for (std::size_t i = batch.first; i < batch.first + batch.count; ++i)
        if (case_.runs[i].run == result->run) found_[i] = std::move(*result);
    });
  }

  /// All have done their parts: process 0 waits for the rows of the others.
  void bring_together(const Batch& batch) {
    if (is_helper()) {
      const std::scoped_lock lock{busy_};
      return session_.ranks->send_end();
    }
    constexpr std::chrono::milliseconds look_every{5};
    while (session_.signal() == 0) {
      {
        const std::scoped_lock lock{busy_};
        receive(batch);
        if (ends_ + 1 == session_.ranks->count()) return;
        write_rows_now_and_then(batch);
      }
      std::this_thread::sleep_for(look_every);
    }
  }

  /// The rows of a study that are done, under the lock; results are what counts, so a failure is a warning, once.
  void write_rows(const Batch& batch) {
    if (!can_write_) return;
    std::vector<const StudyResult*> done;
    for (std::size_t i = batch.first; i < batch.first + batch.count; ++i)
      if (found_[i]) done.push_back(&*found_[i]);
    try {
      io::write_row_checkpoint(folder_, case_, case_.runs[batch.first].study, done);
    } catch (const std::runtime_error& error) {
      can_write_ = false;
      say(session_.err, std::string{"warning: no checkpoint: "} + error.what());
    }
  }

  bool is_over() {
    const std::scoped_lock lock{busy_};
    return closed_ || failed_ != nullptr;
  }

  /// Of several threads the first run counts.
  void fail(const PlannedRun& planned) {
    const std::scoped_lock lock{busy_};
    fail_locked(planned);
    if (is_helper()) session_.ranks->send(std::to_string(&planned - &case_.runs[batch_.first]));
  }

  void fail_locked(const PlannedRun& planned) {
    if (failed_ == nullptr || planned.run < failed_->run) failed_ = &planned;
  }

  static constexpr char in_work = 1, has_ended = 2;

  const Arguments arguments_;
  const fs::path folder_;
  const std::shared_ptr<const io::Case> owned_;
  const io::Case& case_ = *owned_;
  const Session session_;
  Progress progress_;
  std::vector<std::optional<StudyResult>> found_;
  std::vector<char> interrupted_, begun_;  ///< not of bits: several threads write
  std::mutex busy_{};                      ///< progress, what was found and checkpoints
  Batch batch_{};                          ///< what is being run
  std::vector<char> elsewhere_{};          ///< runs that this process leaves to others
  bool is_divided_ = false;                ///< the batch, among several processes
  int ends_ = 0;                           ///< processes that have sent all their rows
  std::size_t ended_ = 0;                  ///< runs of the batch
  bool counting_ = false;                  ///< progress is that of the batch
  bool closed_ = false;                    ///< what was found has been taken
  std::chrono::steady_clock::time_point written_{};
  bool can_write_ = true;
  const PlannedRun* failed_ = nullptr;
};

}  // namespace

bool Results::all_done(const io::Case& the_case) const {
  return list.size() == the_case.runs.size() &&
         std::none_of(interrupted.begin(), interrupted.end(), [](bool was) { return was; });
}

Results run_all(const Arguments& arguments, const fs::path& folder,
                std::shared_ptr<const io::Case> the_case, const Session& session) {
  const auto runner = std::make_shared<Runner>(arguments, folder, std::move(the_case), session);
  const auto work = [runner] {
    runner->run();
    return true;
  };
  Patience patience{stop_request_of(session)};
  done_in_time<bool>(work, session, patience);
  Results results = runner->collected();
  results.signal_since = patience.since();
  return results;
}

}  // namespace springfold::cli
