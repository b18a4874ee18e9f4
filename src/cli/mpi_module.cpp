// The module that is loaded by the processes of mpirun.
#include <mpi.h>

#include "mpi_calls.hpp"

namespace springfold::cli {
namespace {

constexpr int row_tag = 1, end_tag = 2;

bool begin(int& number, int& count) {
  int given = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given);
  if (given < MPI_THREAD_SERIALIZED) return false;
  MPI_Comm_rank(MPI_COMM_WORLD, &number);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return true;
}

void end() { MPI_Finalize(); }

bool all(bool mine) {
  int here = mine ? 1 : 0, everywhere = 0;
  MPI_Allreduce(&here, &everywhere, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return everywhere == 1;
}

void share(char* flags, int size) { MPI_Bcast(flags, size, MPI_CHAR, 0, MPI_COMM_WORLD); }

void send(const std::string& text) {
  MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, row_tag, MPI_COMM_WORLD);
}

void send_end() { MPI_Send(nullptr, 0, MPI_CHAR, 0, end_tag, MPI_COMM_WORLD); }

MpiCalls::Arrival receive(std::string& text) {
  int arrived = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
  if (arrived == 0) return MpiCalls::Arrival::none;
  MPI_Get_count(&status, MPI_CHAR, &size);
  text.assign(static_cast<std::size_t>(size), '\0');
  MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return status.MPI_TAG == end_tag ? MpiCalls::Arrival::end : MpiCalls::Arrival::text;
}

constexpr MpiCalls calls{begin, end, all, share, send, send_end, receive};

}  // namespace
}  // namespace springfold::cli

extern "C" const springfold::cli::MpiCalls* springfold_mpi_calls() {
  return &springfold::cli::calls;
}
