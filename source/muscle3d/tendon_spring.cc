#include <myolines/materials/curves.h>
#include <myolines/muscle3d/tendon_spring.h>

#include <algorithm>

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

    private:
      const double stiffness_;
    };

    class TendinousSpring : public TendonSpring
    {
    public:
      TendinousSpring(const double force, const double length)
        : force_(force)
        , length_(length)
      {}
      double force(const double s) const override { return force_ * curves::tendon(1 + s / length_).value; }
      double slope(const double s) const override { return force_ / length_ * curves::tendon(1 + s / length_).slope; }

      /// Simpson's rule, exact between the knots of the curve.
      double energy(const double s) const override
      {
        const double end  = 1 + s / length_;
        const auto   from = [&](const double begin, const double stop) {
          const double middle = (begin + stop) / 2;
          return (stop - begin) / 6 * (curves::tendon(begin).value + 4 * curves::tendon(middle).value + curves::tendon(stop).value);
        };
        if (end < 1)
          return -force_ * length_ * 0.01 * (1 - end * end) / 2; // sT = 0.01 stretch there
        double sum = 0, begin = 1;
        for (const double knot : {1.01, 1.02, 1.15, end})
          if (const double stop = std::min(knot, end); stop > begin)
            {
              sum += from(begin, stop);
              begin = stop;
            }
        return force_ * length_ * sum;
      }

    private:
      const double force_, length_;
    };
  } // namespace

  std::unique_ptr<TendonSpring> make_linear_spring(const double stiffness) { return std::make_unique<LinearSpring>(stiffness); }

  std::unique_ptr<TendonSpring> make_tendinous_spring(const double force, const double slack_length)
  {
    return std::make_unique<TendinousSpring>(force, slack_length);
  }

  scene::Schema tendon_spring_schema()
  {
    using scene::Range;
    scene::Schema linear("Force proportional to the elongation, of both signs.");
    linear.number("stiffness", std::nullopt, "N/m", Range::positive(), "Force per elongation.");
    scene::Schema tendinous("The curve of tendon and aponeurosis (thesis A.2.4) of the stretch, 0.01 of the force below at slack length.");
    tendinous
        .number("force", std::nullopt, "N", Range::positive(), "Force where the curve is 1: maximum isometric stress times cross-section.")
        .number("slack length", std::nullopt, "m", Range::positive(), "Length of the tendon at elongation zero.");
    return scene::Schema("Law of the tendon.").variant("type", "linear", {{"linear", linear}, {"tendinous", tendinous}}, "Kind of law.");
  }

  std::unique_ptr<TendonSpring> read_tendon_spring(const scene::Node &node)
  {
    return node.text("type") == "linear" ? make_linear_spring(node.number("stiffness"))
                                         : make_tendinous_spring(node.number("force"), node.number("slack length"));
  }
} // namespace myolines
