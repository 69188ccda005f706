// SPDX-License-Identifier: LGPL-2.1-or-later
// What two processes gain where memory is the limit: `triad` alone, then `mpirun -np 2 triad`. Prints GB/s of all processes together.
#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <vector>

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  int rank, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);

  const std::size_t   n = 40000000 / ranks; // 960 MB in all: far beyond caches
  std::vector<double> a(n, 1.), b(n, 2.), c(n, 3.);
  double              best = 1e30;
  for (int repetition = 0; repetition < 20; ++repetition)
    {
      MPI_Barrier(MPI_COMM_WORLD);
      const double begin = MPI_Wtime();
      for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + 0.4 * c[i];
      MPI_Barrier(MPI_COMM_WORLD);
      best          = std::min(best, MPI_Wtime() - begin);
      b[repetition] = a[n - 1 - repetition]; // the sums are used
    }
  if (rank == 0)
    std::printf("%.3f\n", 24e-9 * double(n) * ranks / best);
  MPI_Finalize();
}
