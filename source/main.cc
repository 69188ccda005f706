#include <myolines/cli/program.h>

#include <deal.II/base/mpi.h>

int main(int argc, char **argv)
{
  // one thread a rank: threads inside the vector operations only compete with the ranks
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return myolines::program(argc, argv);
}
