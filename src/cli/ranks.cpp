#include "ranks.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#if SPRINGFOLD_HAS_MPI
#include <mpi.h>
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

}  // namespace

#if SPRINGFOLD_HAS_MPI

namespace {
constexpr int row_tag = 1, end_tag = 2;
}  // namespace

bool Ranks::are_built_in() { return true; }
bool Ranks::are_missed() { return false; }

Ranks::Ranks() {
  if (given_count() == nullptr) return;  // to begin MPI takes time, and a daemon
  int given = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
  begun_ = true;
  if (given < MPI_THREAD_SERIALIZED) return;
  MPI_Comm_rank(MPI_COMM_WORLD, &number_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
  if (begun_ && !gave_up_) MPI_Finalize();
}

bool Ranks::all(bool mine) const {
  if (!are_several()) return mine;
  int here = mine ? 1 : 0, everywhere = 0;
  MPI_Allreduce(&here, &everywhere, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return everywhere == 1;
}

void Ranks::share(std::vector<char>& flags) const {
  if (!are_several()) return;
  MPI_Bcast(flags.data(), static_cast<int>(flags.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
}

void Ranks::send(const std::string& text) const {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, row_tag, MPI_COMM_WORLD);
}

void Ranks::send_end() const { MPI_Send(nullptr, 0, MPI_CHAR, 0, end_tag, MPI_COMM_WORLD); }

int Ranks::receive(const std::function<void(const std::string&)>& take) const {
  int ends = 0;
  for (;;) {
    int arrived = 0, size = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
    if (arrived == 0) return ends;
    MPI_Get_count(&status, MPI_CHAR, &size);
    std::string text(static_cast<std::size_t>(size), '\0');
    MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    if (status.MPI_TAG == end_tag)
      ++ends;
    else
      take(text);
  }
}

#else

bool Ranks::are_built_in() { return false; }
bool Ranks::are_missed() { return given_count() != nullptr; }
Ranks::Ranks() = default;
Ranks::~Ranks() = default;
bool Ranks::all(bool mine) const { return mine; }
void Ranks::share(std::vector<char>&) const {}
void Ranks::send(const std::string&) const {}
void Ranks::send_end() const {}
int Ranks::receive(const std::function<void(const std::string&)>&) const { return 0; }

#endif

}  // namespace springfold::cli
