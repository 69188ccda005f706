// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/boundary/tendon_spring.h>
#include <myolines/materials/curves.h>
#include <myolines/materials/hill_curves.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    class LinearSpring : public TendonSpring
    {
    public:
      explicit LinearSpring(const double stiffness)
        : stiffness_(stiffness)
      {}
      double force(const double s) const override { return stiffness_ * s; }
      double slope(double) const override { return stiffness_; }
      double energy(const double s) const override { return stiffness_ / 2 * s * s; }
      Secant secant(const double s0, const double s1) const override { return {stiffness_ / 2 * (s0 + s1), stiffness_ / 2}; }

    private:
      const double stiffness_;
    };

    struct TendinousLaw
    {
      static auto curve(const double stretch) { return curves::tendon(stretch); }

      /// Simpson's rule, exact between the knots of the curve.
      static double energy(const double stretch)
      {
        const auto from = [](const double begin, const double stop) {
          const double middle = (begin + stop) / 2;
          return (stop - begin) / 6 * (curves::tendon(begin).value + 4 * curves::tendon(middle).value + curves::tendon(stop).value);
        };
        if (stretch < 1)
          return -0.01 * (1 - stretch * stretch) / 2; // sT = 0.01 stretch there
        double sum = 0, begin = 1;
        for (const double knot : {1.01, 1.02, 1.15, stretch})
          if (const double stop = std::min(knot, stretch); stop > begin)
            {
              sum += from(begin, stop);
              begin = stop;
            }
        return sum;
      }
    };

    struct HillLaw
    {
      static auto   curve(const double stretch) { return hill::tendon(stretch); }
      static double energy(const double stretch) { return hill::tendon_energy(stretch); }
    };

    /// F0 f(1 + s/L) with the curve f of a law, and its integral from slack.
    template <typename Law>
    class CurvedSpring : public TendonSpring
    {
    public:
      CurvedSpring(const double force, const double length)
        : force_(force)
        , length_(length)
      {}
      double force(const double s) const override { return force_ * Law::curve(1 + s / length_).value; }
      double slope(const double s) const override { return force_ / length_ * Law::curve(1 + s / length_).slope; }
      double energy(const double s) const override { return force_ * length_ * Law::energy(1 + s / length_); }
      double slack_length() const override { return length_; }

      /// Below a millionth of the length rounding of the energy would be what is left: there the force in the middle misses less than that.
      Secant secant(const double s0, const double s1) const override
      {
        const double change = s1 - s0, middle = (s0 + s1) / 2;
        if (std::abs(change) < 1e-6 * length_)
          return {force(middle), slope(middle) / 2};
        const double value = (energy(s1) - energy(s0)) / change;
        return {value, (force(s1) - value) / change};
      }

    private:
      const double force_, length_;
    };

    class StopSpring : public TendonSpring
    {
    public:
      explicit StopSpring(const double stiffness)
        : stiffness_(stiffness)
      {}
      double force(const double s) const override { return stiffness_ * std::min(s, 0.); }
      double slope(const double s) const override { return s <= 0 ? stiffness_ : 0; }
      double energy(const double s) const override { return stiffness_ / 2 * std::pow(std::min(s, 0.), 2); }

      /// The share of the way that is behind the stop times the mean force there.
      Secant secant(const double s0, const double s1) const override
      {
        const double behind0 = std::min(s0, 0.), behind1 = std::min(s1, 0.), change = s1 - s0;
        const double share = change != 0 ? (behind1 - behind0) / change
                             : s1 <= 0   ? 1.
                                         : 0.,
                     value = stiffness_ / 2 * (behind0 + behind1) * share;
        if (share == 0 || share == 1)
          return {value, share * stiffness_ / 2};
        return {value, (force(s1) - value) / change};
      }

    private:
      const double stiffness_;
    };
  } // namespace

  std::unique_ptr<TendonSpring> make_linear_spring(const double stiffness) { return std::make_unique<LinearSpring>(stiffness); }

  std::unique_ptr<TendonSpring> make_hill_spring(const double force, const double slack_length)
  {
    return std::make_unique<CurvedSpring<HillLaw>>(force, slack_length);
  }

  std::unique_ptr<TendonSpring> make_stop_spring(const double stiffness) { return std::make_unique<StopSpring>(stiffness); }

  std::unique_ptr<TendonSpring> make_tendinous_spring(const double force, const double slack_length)
  {
    return std::make_unique<CurvedSpring<TendinousLaw>>(force, slack_length);
  }

  scene::Schema tendon_spring_schema()
  {
    using scene::Range;
    scene::Schema linear("Force proportional to the elongation, of both signs.");
    linear.number("stiffness", std::nullopt, "N/m", Range::positive(), "Force per elongation.");
    const auto stretched = [](scene::Schema schema) {
      schema
          .number("force", std::nullopt, "N", Range::positive(),
                  "Force where the curve is 1: maximum isometric stress times cross-section.")
          .number("slack length", std::nullopt, "m", Range::positive(), "Length of the tendon at elongation zero.");
      return schema;
    };
    const scene::Schema tendinous = stretched(
        scene::Schema("The curve of tendon and aponeurosis (thesis A.2.4) of the stretch, 0.01 of the force below at slack length."));
    const scene::Schema hill =
        stretched(scene::Schema("The curve of the tendon in one dimension (thesis, table A.4) of the stretch, that of the "
                                "muscle-tendon unit: 1 at stretch 1.058, 0.0097 at slack length."));
    return scene::Schema("Law of the tendon.")
        .variant("type", "linear", {{"linear", linear}, {"tendinous", tendinous}, {"hill", hill}}, "Kind of law.");
  }

  std::unique_ptr<TendonSpring> read_tendon_spring(const scene::Node &node)
  {
    const std::string type = node.text("type");
    if (type == "linear")
      return make_linear_spring(node.number("stiffness"));
    return (type == "hill" ? make_hill_spring : make_tendinous_spring)(node.number("force"), node.number("slack length"));
  }
} // namespace myolines
