// SPDX-License-Identifier: LGPL-2.1-or-later
// Cost of the cell kernels, per cell: `build/release/tests/benchmark_kernels`.
#include "../muscle3d/fixtures.h"

#include <deal.II/base/mpi.h>

#include <benchmark/benchmark.h>

namespace myolines
{
  namespace
  {
    /// A block of 512 cells in a smooth state, for one degree, point count and instruction set.
    struct Bench
    {
      Bench(const unsigned int degree, const unsigned int n_points, const InstructionSet set)
        : parameters(test::small_block(degree, n_points, 3))
        , d(parameters, MPI_COMM_SELF, set)
        , materials(parameters, *d.batches, d.element, nullptr)
        , sweep(d.sweep(materials))
        , model(kernel_model(parameters, parameters.activation_at(0, Side::left)))
        , u(d.space->make_vector())
        , v(u)
        , a(u)
        , r(u)
        , matrices(std::size_t(9) * d.element.n_nodes * d.element.n_nodes * n_lanes)
      {
        model.keep_gradient = keeps_gradient(set);
        test::randomise(u, 1e-6, 1);
        test::randomise(v, 1e-4, 2);
        test::randomise(a, 1, 3);
      }

      template <typename Kernel>
      void measure(benchmark::State &state, const Kernel &kernel)
      {
        for (auto _ : state)
          for (unsigned int b = 0; b < d.batches->n_owned_batches(); ++b)
            kernel(sweep.cells(b));
        state.counters["time/cell"] = benchmark::Counter(double(d.batches->n_owned_batches()) * n_lanes,
                                                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
        state.SetLabel(name(d.instruction_set));
      }

      Muscle3dParameters            parameters;
      Muscle3dDiscretisation        d;
      PointMaterials                materials;
      CellSweep                     sweep;
      KernelModel                   model;
      Vector                        u, v, a, r;
      dealii::AlignedVector<double> matrices;
    };

    bool available(benchmark::State &state, const InstructionSet set)
    {
      if (set > widest_instruction_set())
        state.SkipWithError("this processor lacks the instruction set");
      return set <= widest_instruction_set();
    }

    void residual(benchmark::State &state)
    {
      const auto set = static_cast<InstructionSet>(state.range(2));
      if (!available(state, set))
        return;
      Bench s(state.range(0), state.range(1), set);
      s.measure(state, [&](const KernelCells &cells) {
        KernelForces forces;
        s.d.kernels.residual(s.d.tables, s.model, cells, s.u.begin(), s.v.begin(), s.a.begin(), s.r.begin(), forces, s.d.scratch());
      });
    }

    void apply(benchmark::State &state, const bool exact)
    {
      const auto set = static_cast<InstructionSet>(state.range(2));
      if (!available(state, set))
        return;
      Bench                         s(state.range(0), state.range(1), set);
      const double                  w[3]      = {1, 40, 1600};
      const unsigned int            n         = s.d.batches->n_owned_batches();
      const std::size_t             size      = tangent_size(s.d.element.n_points, s.model);
      const std::size_t             of_volume = std::size_t(VolumeLayout(s.d.element.n_modes).size) * n_lanes;
      dealii::AlignedVector<float>  high(n * size), low(n * size);
      dealii::AlignedVector<double> volume(n * of_volume);
      const auto                    tangent = [&](const unsigned int b) {
        return KernelTangent{s.u.begin(), s.v.begin(), &high[b * size], exact ? &low[b * size] : nullptr, &volume[b * of_volume]};
      };
      for (unsigned int b = 0; b < n; ++b)
        s.d.kernels.linearise(s.d.tables, s.model, s.sweep.cells(b), s.u.begin(), s.v.begin(), &high[b * size], &low[b * size],
                              &volume[b * of_volume], s.d.scratch());
      unsigned int b = 0;
      s.measure(state, [&](const KernelCells &cells) {
        s.d.kernels.apply(s.d.tables, s.model, cells, w, tangent(b++ % n), s.a.begin(), s.r.begin(), nullptr, s.d.scratch());
      });
    }

    void tangent_action(benchmark::State &state) { apply(state, true); }
    void smoother_action(benchmark::State &state) { apply(state, false); }

    void element_matrices(benchmark::State &state)
    {
      const auto set = static_cast<InstructionSet>(state.range(2));
      if (!available(state, set))
        return;
      Bench        s(state.range(0), state.range(1), set);
      const double w[3] = {1, 40, 1600};
      s.measure(state, [&](const KernelCells &cells) {
        s.d.kernels.element_matrices(s.d.tables, s.model, cells, w, s.u.begin(), s.v.begin(), s.matrices.data(), s.d.scratch());
      });
    }

    void arguments(benchmark::internal::Benchmark *benchmark)
    {
      benchmark->ArgNames({"degree", "points", "set"});
      for (const int set : {0, 1, 2})
        for (const auto &[degree, points] : {std::make_pair(2, 3), std::make_pair(2, 4), std::make_pair(2, 5), std::make_pair(3, 4)})
          benchmark->Args({degree, points, set});
      benchmark->Unit(benchmark::kMillisecond);
    }

    BENCHMARK(residual)->Apply(arguments);
    BENCHMARK(tangent_action)->Apply(arguments);
    BENCHMARK(smoother_action)->Apply(arguments);
    BENCHMARK(element_matrices)->Apply(arguments);
  } // namespace
} // namespace myolines

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
