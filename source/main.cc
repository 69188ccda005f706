#include <myolines/cli/mpi_session.h>
#include <myolines/cli/program.h>

int main(int argc, char **argv)
{
  myolines::MpiSession mpi(argc, argv);
  return myolines::program(argc, argv, mpi);
}
