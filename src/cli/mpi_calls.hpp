// What `Ranks` asks of MPI. The calls are in a module that only the processes of mpirun load: to load MPI's own
// libraries takes as long as to trace a curve.
#pragma once

#include <string>

namespace springfold::cli {

struct MpiCalls {
  /// Begins MPI. @returns false where it cannot serve threads one at a time: number and count stay as they are
  bool (*begin)(int& number, int& count);
  void (*end)();
  bool (*all)(bool mine);
  void (*share)(char* flags, int size);
  void (*send)(const std::string& text);
  void (*send_end)();
  enum class Arrival { none, text, end };
  Arrival (*receive)(std::string& text);
};

/// Name of the module's only function, of this type.
inline constexpr const char* mpi_calls_name = "springfold_mpi_calls";
using GetMpiCalls = const MpiCalls* (*)();

}  // namespace springfold::cli
