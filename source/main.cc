#include <myolines/cli/program.h>

#include <deal.II/base/mpi.h>

// Of OpenBLAS, where that is the BLAS in use.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

int main(int argc, char **argv)
{
  // One thread a rank: threads inside vector and matrix operations only compete with the ranks.
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (openblas_set_num_threads != nullptr)
    openblas_set_num_threads(1);
  return myolines::program(argc, argv);
}
