#include "ranks.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "mpi_calls.hpp"

#if SPRINGFOLD_HAS_MPI
#include <dlfcn.h>

#include <filesystem>
#endif

namespace springfold::cli {
namespace {

/// What Open MPI, PMIx and PMI (Slurm) set in the processes that they start: how many there are.
const char* given_count() {
  constexpr std::array<const char*, 3> names{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE",
                                             "SLURM_STEP_NUM_TASKS"};
  for (const char* name : names)
    if (const char* value = std::getenv(name); value != nullptr && std::atoi(value) > 1)
      return value;
  return nullptr;
}

#if SPRINGFOLD_HAS_MPI

/// The module beside the program, or where it is installed. It stays loaded until the process ends.
const MpiCalls* load_calls() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return nullptr;
  for (const auto& folder : {program, program / SPRINGFOLD_MODULES}) {
    // Components of Open MPI look for its symbols among those of all.
    void* module = ::dlopen((folder / "springfold_mpi.so").c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (module == nullptr) continue;
    const auto get = reinterpret_cast<GetMpiCalls>(::dlsym(module, mpi_calls_name));
    return get == nullptr ? nullptr : get();
  }
  return nullptr;
}

#else

const MpiCalls* load_calls() { return nullptr; }

#endif

}  // namespace

bool Ranks::are_built_in() { return SPRINGFOLD_HAS_MPI != 0; }

Ranks::Ranks() {
  if (given_count() == nullptr) return;  // to begin MPI takes time, and a daemon
  calls_ = load_calls();
  if (calls_ != nullptr) calls_->begin(number_, count_);
}

Ranks::~Ranks() {
  if (calls_ != nullptr && !gave_up_) calls_->end();
}

bool Ranks::are_missed() const { return given_count() != nullptr && calls_ == nullptr; }

bool Ranks::all(bool mine) const { return are_several() ? calls_->all(mine) : mine; }

void Ranks::share(std::vector<char>& flags) const {
  if (are_several()) calls_->share(flags.data(), static_cast<int>(flags.size()));
}

void Ranks::send(const std::string& text) const { calls_->send(text); }

void Ranks::send_end() const { calls_->send_end(); }

int Ranks::receive(const std::function<void(const std::string&)>& take) const {
  int ends = 0;
  std::string text;
  while (are_several()) {
    const MpiCalls::Arrival arrival = calls_->receive(text);
    if (arrival == MpiCalls::Arrival::none) break;
    if (arrival == MpiCalls::Arrival::end)
      ++ends;
    else
      take(text);
  }
  return ends;
}

}  // namespace springfold::cli
