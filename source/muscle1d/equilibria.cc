// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle1d/equilibria.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace myolines
{
  namespace
  {
    constexpr double shortest = 0.3, longest = 3; ///< stretches that are looked at

    /// A range of stretches where the force rises, or falls, throughout.
    struct Branch
    {
      double begin, end, begin_force, end_force;

      double low() const { return std::min(begin_force, end_force); }
      double high() const { return std::max(begin_force, end_force); }
    };

    /// Where @p negative changes in [a, b], from its value at a, to the last digit.
    double change(const std::function<bool(double)> &negative, double a, double b)
    {
      const bool at_a = negative(a);
      for (double middle = (a + b) / 2; middle != a && middle != b; middle = (a + b) / 2)
        (negative(middle) == at_a ? a : b) = middle;
      return (a + b) / 2;
    }

    class Branches
    {
    public:
      Branches(const HillForce &force, const double activation)
        : force_(force)
        , activation_(activation)
      {
        constexpr double step  = 1e-3;
        double           begin = shortest;
        int              sign  = sign_at(begin);
        for (double x = shortest + step; x < longest + step / 2; x += step)
          if (sign_at(x) != sign)
            {
              const int    before = sign;
              const double end    = change([&](double y) { return sign_at(y) != before; }, x - step, x);
              add(begin, end, sign);
              begin = end;
              sign  = sign_at(x);
            }
        add(begin, longest, sign);
      }

      std::size_t   size() const { return all_.size(); }
      const Branch &operator[](const std::size_t k) const { return all_[k]; }
      hill::Curve   at(const double stretch) const { return force_.isometric(stretch, activation_); }

      /// The stretch on branch @p k with the force @p f of its range.
      double stretch(const std::size_t k, const double f) const
      {
        const bool rises = all_[k].begin_force < all_[k].end_force;
        double     a = all_[k].begin, b = all_[k].end;
        for (double middle = (a + b) / 2; middle != a && middle != b; middle = (a + b) / 2)
          ((at(middle).value < f) == rises ? a : b) = middle;
        return (a + b) / 2;
      }

    private:
      int sign_at(const double stretch) const
      {
        const double slope = at(stretch).slope;
        return slope > 0 ? 1 : slope < 0 ? -1 : 0;
      }

      /// A force that neither rises nor falls is zero, where nothing holds the element.
      void add(const double begin, const double end, const int sign)
      {
        if (sign != 0)
          all_.push_back({begin, end, at(begin).value, at(end).value});
      }

      const HillForce    &force_;
      const double        activation_;
      std::vector<Branch> all_;
    };

    unsigned int unstable(const std::vector<unsigned int> &elements, const std::vector<double> &slopes)
    {
      unsigned int negative   = 0;
      double       compliance = 0;
      for (std::size_t k = 0; k < slopes.size(); ++k)
        {
          negative += slopes[k] < 0 ? elements[k] : 0;
          compliance += elements[k] / slopes[k];
        }
      return negative - (compliance < 0 ? 1 : 0);
    }

    /// All equilibria with these numbers of elements on the branches.
    void add_equilibria(const Branches &branches, const std::vector<unsigned int> &elements, const double length,
                        std::vector<ChainEquilibrium> &all)
    {
      double low = -INFINITY, high = INFINITY;
      for (std::size_t k = 0; k < elements.size(); ++k)
        if (elements[k] > 0)
          {
            low  = std::max(low, branches[k].low());
            high = std::min(high, branches[k].high());
          }
      if (!(low < high))
        return;
      const auto too_long = [&](const double f) {
        double sum = 0;
        for (std::size_t k = 0; k < elements.size(); ++k)
          if (elements[k] > 0)
            sum += elements[k] * branches.stretch(k, f);
        return sum > length;
      };
      constexpr unsigned int n      = 500;
      const auto             sample = [&](const unsigned int i) { return i == n ? high : low + (high - low) * i / n; };
      bool                   before = too_long(low);
      for (unsigned int i = 1; i <= n; ++i)
        {
          const bool now = too_long(sample(i));
          if (now != before)
            {
              ChainEquilibrium equilibrium;
              equilibrium.force    = change(too_long, sample(i - 1), sample(i));
              equilibrium.elements = elements;
              for (std::size_t k = 0; k < elements.size(); ++k)
                {
                  equilibrium.stretches.push_back(
                      branches.stretch(k, std::clamp(equilibrium.force, branches[k].low(), branches[k].high())));
                  equilibrium.slopes.push_back(branches.at(equilibrium.stretches.back()).slope);
                }
              equilibrium.unstable_directions = unstable(elements, equilibrium.slopes);
              all.push_back(equilibrium);
            }
          before = now;
        }
    }
  } // namespace

  std::vector<ChainEquilibrium> chain_equilibria(const HillForce &force, const double activation, const unsigned int n_elements,
                                                 const double stretch)
  {
    const Branches                branches(force, activation);
    std::vector<ChainEquilibrium> all;
    std::vector<unsigned int>     elements(branches.size(), 0);

    const std::function<void(std::size_t, unsigned int)> distribute = [&](const std::size_t k, const unsigned int left) {
      if (k + 1 == elements.size())
        {
          elements[k] = left;
          add_equilibria(branches, elements, n_elements * stretch, all);
          return;
        }
      for (unsigned int here = 0; here <= left; ++here)
        {
          elements[k] = here;
          distribute(k + 1, left - here);
        }
    };
    if (!elements.empty())
      distribute(0, n_elements);
    return all;
  }
} // namespace myolines
