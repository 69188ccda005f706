// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/materials/curve_set.h>
#include <myolines/scene/csv.h>

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <boost/math/interpolators/pchip.hpp>

#include <cmath>
#include <functional>

namespace myolines
{
  PiecewiseCurve::PiecewiseCurve(std::vector<double> s, const std::vector<double> &values, const std::vector<double> &slopes,
                                 const Beyond beyond)
    : knots_(std::move(s))
  {
    const std::size_t last = knots_.size() - 1;
    for (std::size_t i = 0; i < last; ++i)
      {
        const double h = knots_[i + 1] - knots_[i], secant = (values[i + 1] - values[i]) / h;
        cubics_.push_back(
            {{values[i], slopes[i], (3 * secant - 2 * slopes[i] - slopes[i + 1]) / h, (slopes[i] + slopes[i + 1] - 2 * secant) / (h * h)}});
      }
    const double factor = beyond == Beyond::linear ? 1 : 0;
    cubics_.push_back({{values[last], factor * slopes[last], 0, 0}});
    cubics_.push_back({{values[0], factor * slopes[0], 0, 0}});
  }

  curves::Pieces PiecewiseCurve::pieces() const
  {
    static_assert(sizeof(std::array<double, 4>) == sizeof(double[4]));
    return {static_cast<int>(knots_.size()), knots_.data(), reinterpret_cast<const double(*)[4]>(cubics_.data())};
  }

  namespace
  {
    using scene::Node;
    using scene::Schema;

    /// The spline through @p curve at @p n knots @p h apart from @p begin on, with its slopes at both ends.
    PiecewiseCurve spline_through(const std::function<curves::Curve<double>(double)> &curve, const double begin, const double h,
                                  const unsigned int n)
    {
      std::vector<double> s, values;
      for (unsigned int i = 0; i < n; ++i)
        {
          s.push_back(begin + i * h);
          values.push_back(curve(s.back()).value);
        }
      const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(values.begin(), values.end(), begin, h,
                                                                               curve(s.front()).slope, curve(s.back()).slope);
      std::vector<double>                                               slopes;
      for (const double x : s)
        slopes.push_back(spline.prime(x));
      return PiecewiseCurve(s, values, slopes, PiecewiseCurve::Beyond::linear);
    }

    /// The monotone cubic through the points of a file.
    PiecewiseCurve read_points(const Node &node, const std::string &parameter, const std::string &abscissa,
                               const PiecewiseCurve::Beyond beyond)
    {
      if (!node.has(parameter))
        return {};
      const scene::CsvTable table = scene::read_csv_input(node.file(parameter));
      std::vector<double>   s     = table.numbers(table.required_column(abscissa));
      std::vector<double>   value = table.numbers(table.required_column("stress"));
      for (std::size_t row = 1; row < s.size(); ++row)
        if (!(s[row] > s[row - 1]))
          throw InputError(InputProblem{table.where(row), "the " + abscissa + " does not ascend", "strictly ascending numbers", ""});
      if (s.size() < 4)
        throw InputError(InputProblem{table.file.string(), "holds " + std::to_string(s.size()) + " points", "at least four", ""});
      const boost::math::interpolators::pchip<std::vector<double>> curve{std::vector<double>(s), std::vector<double>(value)};
      std::vector<double>                                          slopes;
      for (const double x : s)
        slopes.push_back(curve.prime(x));
      return PiecewiseCurve(s, value, slopes, beyond);
    }
  } // namespace

  CurveSet smooth_curves()
  {
    CurveSet smooth;
    smooth.active         = spline_through([](const double s) { return curves::active(s); }, 0.2, 0.02, 91);
    smooth.passive        = spline_through([](const double s) { return curves::passive(s); }, 0.8, 0.02, 61);
    smooth.force_velocity = spline_through([](const double e) { return curves::force_velocity(e); }, -1.4, 0.01, 241);
    smooth.tendon         = spline_through([](const double s) { return curves::tendon(s); }, 0.96, 0.002, 121);
    return smooth;
  }

  Schema curves_schema()
  {
    Schema table("Monotone cubics (Fritsch and Carlson, doi:10.1137/0717021) through points of CSV files with a column \"stress\" and one "
                 "for the stretch or the strain rate; curves without a file are those of the thesis.");
    table.optional_file("active", "Columns stretch, stress: active stress over sigma0; its end values hold outside.")
        .optional_file("passive", "Columns stretch, stress: passive stress of muscle over sigma0; its end slopes hold outside.")
        .optional_file("force-velocity",
                       "Columns strain rate, stress: factor of the active stress, 1 at rate 0 by definition; its end values hold outside.")
        .optional_file("tendon", "Columns stretch, stress: stress of aponeurosis and tendon over sigma0; its end slopes hold outside.");
    return Schema("Curves of the fibre stress against stretch and strain rate, of all tissues.")
        .variant("type", "thesis",
                 {{"thesis", Schema("Appendix A.2 of the thesis: piecewise polynomials with kinks.")},
                  {"smooth", Schema("C2 splines through those of the thesis, for studies of orders of accuracy.")},
                  {"table", table}},
                 "Which curves.");
  }

  std::shared_ptr<const CurveSet> read_curves(const Node &node)
  {
    const std::string type = node.text("type");
    if (type == "thesis")
      return nullptr;
    if (type == "smooth")
      return std::make_shared<CurveSet>(smooth_curves());
    using Beyond          = PiecewiseCurve::Beyond;
    auto table            = std::make_shared<CurveSet>();
    table->active         = read_points(node, "active", "stretch", Beyond::constant);
    table->passive        = read_points(node, "passive", "stretch", Beyond::linear);
    table->force_velocity = read_points(node, "force-velocity", "strain rate", Beyond::constant);
    table->tendon         = read_points(node, "tendon", "stretch", Beyond::linear);
    return table;
  }
} // namespace myolines
