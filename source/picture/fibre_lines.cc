// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/materials/tissue.h>
#include <myolines/picture/fibre_lines.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines::picture
{
  namespace
  {
    constexpr const char *fibre_field = "fibre direction";

    double volume(const std::array<Vec, 3> &d) { return cross_product_3d(d[0], d[1]) * d[2]; }

    /// y with d y = x, by Cramer's rule; false where d is singular.
    bool solve(const std::array<Vec, 3> &d, const Vec &x, Vec &y)
    {
      const double whole = volume(d);
      if (!(std::abs(whole) > 1e-12 * d[0].norm() * d[1].norm() * d[2].norm()))
        return false;
      y = Vec({volume({{x, d[1], d[2]}}) / whole, volume({{d[0], x, d[2]}}) / whole, volume({{d[0], d[1], x}}) / whole});
      return true;
    }

    /// Directions of fibres at rest, pulled back from the directions F a0 in the file.
    class Directions
    {
    public:
      explicit Directions(const Body &body)
        : body_(body)
        , locator_(body)
        , tissue_(body.find("tissue"))
        , fibre_(body.find(fibre_field))
      {}

      /// Unit; nothing outside of the body, and in aponeurosis and tendon, which are no fibres of a muscle.
      std::optional<Vec> at(const Vec &rest) const
      {
        const auto found = locator_.find(rest);
        if (!found)
          return std::nullopt;
        const Body::Cell &cell   = body_.cells[found->cell];
        const long        tissue = tissue_ == nullptr ? muscle_id : std::lround(value(*tissue_, 0, cell, found->xi));
        if (tissue == aponeurosis_id || tissue == tendon_id)
          return std::nullopt;
        Vec now, in_cell;
        for (unsigned int c = 0; c < 3; ++c)
          now[c] = value(*fibre_, c, cell, found->xi);
        if (!(now.norm() > 0.1) || !solve(derivatives(body_.now, cell, found->xi), now, in_cell))
          return std::nullopt;
        const std::array<Vec, 3> d      = derivatives(body_.rest, cell, found->xi);
        const Vec                before = in_cell[0] * d[0] + in_cell[1] * d[1] + in_cell[2] * d[2];
        return before / before.norm();
      }

    private:
      const Body  &body_;
      CellLocator  locator_;
      const Field *tissue_;
      const Field *fibre_;
    };

    /// One half of a line from @p start on, without it. False if it has no end.
    bool trace(const Directions &directions, Vec x, Vec along, const double step, const std::size_t most, std::vector<Vec> &line)
    {
      const auto turned = [&](const Vec &place) -> std::optional<Vec> {
        const auto d = directions.at(place);
        return d && *d * along < 0 ? -*d : d;
      };
      const auto next = [&](const double h) -> std::optional<Vec> {
        const auto middle = turned(x + h / 2 * along);
        if (!middle)
          return std::nullopt;
        const Vec there = x + h * *middle;
        return directions.at(there) ? std::optional<Vec>(there) : std::nullopt;
      };
      while (line.size() < most)
        {
          auto there = next(step);
          if (!there) // up to the end itself
            {
              double reach = 0, beyond = step;
              for (int i = 0; i < 12; ++i)
                {
                  const double half = (reach + beyond) / 2;
                  if (const auto nearer = next(half))
                    {
                      reach = half;
                      there = nearer;
                    }
                  else
                    beyond = half;
                }
              if (there)
                line.push_back(*there);
              return true;
            }
          x     = *there;
          along = turned(x).value_or(along);
          line.push_back(x);
        }
      return false;
    }

    /// Centres of cells that have fibres, not more than some thousands.
    std::vector<Vec> seeds(const Body &body, const Directions &directions)
    {
      const std::size_t stride = body.cells.size() / 4000 + 1;
      std::vector<Vec>  all;
      for (std::size_t c = 0; c < body.cells.size(); c += stride)
        if (const Vec x = place(body.rest, body.cells[c], Vec({0.5, 0.5, 0.5})); directions.at(x))
          all.push_back(x);
      return all;
    }
  } // namespace

  CellLocator::CellLocator(const Body &body)
    : body_(body)
    , low_(body.rest.front())
  {
    Vec high = low_;
    for (const Vec &x : body.rest)
      for (unsigned int c = 0; c < 3; ++c)
        {
          low_[c] = std::min(low_[c], x[c]);
          high[c] = std::max(high[c], x[c]);
        }
    const double size =
        std::cbrt(std::max((high - low_)[0] * (high - low_)[1] * (high - low_)[2], 1e-300) / static_cast<double>(body.cells.size()));
    for (unsigned int c = 0; c < 3; ++c)
      {
        n_[c]     = static_cast<std::size_t>(std::min(200., std::max(1., std::ceil((high[c] - low_[c]) / size))));
        width_[c] = std::max((high[c] - low_[c]) / static_cast<double>(n_[c]), 1e-300);
      }
    bins_.resize(n_[0] * n_[1] * n_[2]);
    for (std::size_t cell = 0; cell < body.cells.size(); ++cell)
      {
        std::array<std::size_t, 3> first = n_, last{{0, 0, 0}};
        for (const std::size_t p : body.cells[cell])
          for (unsigned int c = 0; c < 3; ++c)
            {
              const double at = (body.rest[p][c] - low_[c]) / width_[c], slack = 1e-3; // points between bins are in both
              first[c] = std::min(first[c], static_cast<std::size_t>(std::max(0., at - slack)));
              last[c]  = std::min(n_[c] - 1, std::max(last[c], static_cast<std::size_t>(at + slack)));
            }
        for (std::size_t k = first[2]; k <= last[2]; ++k)
          for (std::size_t j = first[1]; j <= last[1]; ++j)
            for (std::size_t i = first[0]; i <= last[0]; ++i)
              bins_[i + n_[0] * (j + n_[1] * k)].push_back(cell);
      }
  }

  std::size_t CellLocator::bin_of(const Vec &x) const
  {
    std::size_t bin = 0;
    for (unsigned int c = 3; c-- > 0;)
      {
        const double at = (x[c] - low_[c]) / width_[c];
        if (!(at > -1e-3 && at < static_cast<double>(n_[c]) + 1e-3))
          return bins_.size();
        bin = bin * n_[c] + std::min(n_[c] - 1, static_cast<std::size_t>(std::max(0., at)));
      }
    return bin;
  }

  std::optional<CellLocator::Found> CellLocator::find(const Vec &rest) const
  {
    const std::size_t bin = bin_of(rest);
    if (bin == bins_.size())
      return std::nullopt;
    constexpr double rounding = 1e-4; // files have floats
    for (const std::size_t cell : bins_[bin])
      {
        Vec xi({0.5, 0.5, 0.5}), step;
        for (int i = 0; i < 12; ++i)
          {
            if (!solve(derivatives(body_.rest, body_.cells[cell], xi), rest - place(body_.rest, body_.cells[cell], xi), step))
              break;
            xi += step;
            if (step.norm() < 1e-10 || xi.norm() > 10)
              break;
          }
        const Vec    off  = rest - place(body_.rest, body_.cells[cell], xi); // Newton's method may end elsewhere
        const double size = derivatives(body_.rest, body_.cells[cell], Vec({0.5, 0.5, 0.5}))[0].norm();
        if (off.norm() < rounding * size && *std::min_element(xi.begin_raw(), xi.end_raw()) >= -rounding &&
            *std::max_element(xi.begin_raw(), xi.end_raw()) <= 1 + rounding)
          return Found{cell, xi};
      }
    return std::nullopt;
  }

  bool has_fibres(const Body &body)
  {
    const Field *fibre = body.find(fibre_field);
    return fibre != nullptr && fibre->n_components == 3;
  }

  std::vector<std::vector<Vec>> fibre_lines(const Body &body, const unsigned int number)
  {
    const Directions       directions(body);
    const std::vector<Vec> starts = seeds(body, directions);
    double                 cells  = 0;
    Vec                    low = body.rest.front(), high = low;
    for (const Body::Cell &cell : body.cells)
      {
        cells += std::abs(volume(derivatives(body.rest, cell, Vec({0.5, 0.5, 0.5}))));
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c]  = std::min(low[c], body.rest[cell[0]][c]);
            high[c] = std::max(high[c], body.rest[cell[7]][c]);
          }
      }
    const double                  step = std::cbrt(cells / static_cast<double>(body.cells.size())) / 4;
    const auto                    most = static_cast<std::size_t>(10 * (high - low).norm() / step) + 1;
    std::vector<double>           distance(starts.size(), std::numeric_limits<double>::infinity()); // to the lines that are there
    std::vector<std::vector<Vec>> lines;
    for (unsigned int tried = 0; tried < number && !starts.empty(); ++tried)
      {
        const auto farthest = std::max_element(distance.begin(), distance.end());
        if (!(*farthest > step))
          break;
        const Vec        start = starts[static_cast<std::size_t>(farthest - distance.begin())], along = *directions.at(start);
        std::vector<Vec> back, line;
        const bool       ends = trace(directions, start, -along, step, most, back);
        line.assign(back.rbegin(), back.rend());
        line.push_back(start);
        std::vector<Vec> forth;
        const bool       both = ends && trace(directions, start, along, step, most, forth);
        line.insert(line.end(), forth.begin(), forth.end());
        for (std::size_t s = 0; s < starts.size(); ++s)
          for (const Vec &x : line)
            distance[s] = std::min(distance[s], (x - starts[s]).norm());
        if (both && line.size() > 2)
          lines.push_back(line);
      }
    return lines;
  }

  std::vector<std::vector<LinePoint>> follow(const std::vector<std::vector<Vec>> &lines, const Body &body,
                                             const std::vector<double> &values)
  {
    const CellLocator                   locator(body);
    const Field                         field{"", 1, values};
    std::vector<std::vector<LinePoint>> now;
    for (const auto &line : lines)
      {
        now.emplace_back();
        for (const Vec &x : line)
          if (const auto found = locator.find(x))
            now.back().push_back(
                {place(body.now, body.cells[found->cell], found->xi), value(field, 0, body.cells[found->cell], found->xi)});
      }
    return now;
  }
} // namespace myolines::picture
