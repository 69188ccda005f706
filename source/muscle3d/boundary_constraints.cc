// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/muscle3d/discretisation.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace myolines
{
  namespace
  {
    using dealii::types::global_dof_index;
    using Normal = dealii::Tensor<1, 3>;

    constexpr double negligible = 1e-10; ///< beside 1

    /// sum over c of a_c u_c = sum over k of b_k q_k at a node, q_k what moves face k.
    struct Row
    {
      Normal              a;
      std::vector<double> b;
      int                 pivot = -1;

      void subtract(const double factor, const Row &other)
      {
        a -= factor * other.a;
        for (std::size_t k = 0; k < b.size(); ++k)
          b[k] -= factor * other.b[k];
      }
    };

    /// What is asked of one node.
    struct AtNode
    {
      std::array<bool, 3> prescribed{}, may_move{};
      std::vector<Row>    rows;
    };

    /// Unit normal of a plane face. @throws InputError if it is none.
    Normal normal_of_plane(const BoundaryCondition &condition, const NodeSpace &space)
    {
      dealii::FEFaceValues<3> values(space.nodes().get_fe(), dealii::QGauss<2>(2),
                                     dealii::update_normal_vectors | dealii::update_JxW_values);
      Normal                  sum;
      double                  area = 0;
      for (const NodeSpace::Cell &cell : space.nodes().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == condition.face)
              {
                values.reinit(cell, f);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  {
                    sum += values.JxW(q) * values.normal_vector(q);
                    area += values.JxW(q);
                  }
              }
      sum  = dealii::Utilities::MPI::sum(sum, space.communicator());
      area = dealii::Utilities::MPI::sum(area, space.communicator());
      // All normals are one exactly where their mean has length one; the difference is of second order.
      if (!(sum.norm() > (1 - 1e-12) * area))
        throw InputError(InputProblem{condition.scene_path, "the face of symmetry plane \"" + condition.name + "\" is not plane",
                                      "a plane face", "one condition for each plane part, by faces of their own"});
      for (unsigned int c = 0; c < 3; ++c)
        if (std::abs(sum[c]) < negligible * area)
          sum[c] = 0; // so that planes along the axes tie nothing
      return sum / sum.norm();
    }

    /// Two unit vectors across n and each other, along the axes where n is.
    std::array<Normal, 2> across(const Normal &n)
    {
      unsigned int largest = 0;
      for (unsigned int c = 1; c < 3; ++c)
        if (std::abs(n[c]) > std::abs(n[largest]))
          largest = c;
      Normal first;
      first[(largest + 1) % 3] = 1;
      first -= (first * n) * n;
      first /= first.norm();
      return {{first, cross_product_3d(n, first)}};
    }

    /// What all conditions ask of the nodes that this rank sees, and of those that all ranks know.
    class Demands
    {
    public:
      Demands(const std::vector<BoundaryCondition> &conditions, const NodeSpace &space)
        : space_(space)
      {
        for (const BoundaryCondition &condition : conditions)
          if (condition.moves_as_one())
            tied_.push_back(&condition);
        for (const BoundaryCondition &condition : conditions)
          if (condition.prescribes_motion())
            prescribe(condition);
          else if (condition.constrains())
            tie(condition);
        share();
      }

      std::map<global_dof_index, AtNode>            nodes;
      std::map<std::string, std::array<bool, 3>>    held;
      const std::vector<const BoundaryCondition *> &tied() const { return tied_; }
      global_dof_index                              master(const std::size_t k) const { return space_.shared_nodes().at(tied_[k]->face); }

    private:
      void prescribe(const BoundaryCondition &condition)
      {
        for (const auto node : space_.face_nodes(condition.face))
          for (unsigned int c = 0; c < 3; ++c)
            if (condition.components[c])
              {
                nodes[node].prescribed[c] = true;
                nodes[node].may_move[c]   = condition.may_move(c); // the later condition holds
              }
      }

      void tie(const BoundaryCondition &condition)
      {
        Normal n;
        if (condition.moves_as_one())
          for (unsigned int c = 0; c < 3; ++c)
            n[c] = condition.direction[c];
        else
          n = normal_of_plane(condition, space_);
        std::vector<Row> rows(1);
        rows[0].a = n;
        if (condition.held_across)
          for (const Normal &t : across(n))
            rows.push_back({t, {}});
        for (Row &row : rows)
          {
            row.b.resize(tied_.size());
            for (unsigned int c = 0; c < 3; ++c)
              held[condition.name][c] = held[condition.name][c] || std::abs(row.a[c]) > negligible;
          }
        for (const auto node : space_.face_nodes(condition.face))
          for (std::size_t i = 0; i < rows.size(); ++i)
            {
              Row row = rows[i];
              if (i == 0 && condition.moves_as_one())
                {
                  const std::size_t k = std::find(tied_.begin(), tied_.end(), &condition) - tied_.begin();
                  if (node == master(k))
                    continue; // its motion is q
                  row.b[k] = 1;
                }
              nodes[node].rows.push_back(row);
            }
      }

      /// Tells all ranks of the nodes that all know.
      void share()
      {
        for (std::size_t k = 0; k < tied_.size(); ++k)
          {
            std::vector<double> text;
            if (const auto found = nodes.find(master(k)); found != nodes.end() && space_.owned_unknowns().is_element(3 * master(k)))
              {
                const AtNode &node = found->second;
                for (unsigned int c = 0; c < 3; ++c)
                  text.insert(text.end(), {node.prescribed[c] ? 1. : 0., node.may_move[c] ? 1. : 0.});
                for (const Row &row : node.rows)
                  {
                    text.insert(text.end(), row.a.begin_raw(), row.a.end_raw());
                    text.insert(text.end(), row.b.begin(), row.b.end());
                  }
              }
            for (const auto &told : dealii::Utilities::MPI::all_gather(space_.communicator(), text))
              if (!told.empty())
                hear(master(k), told);
          }
      }

      void hear(const global_dof_index master, const std::vector<double> &text)
      {
        AtNode &node = nodes[master];
        node         = AtNode();
        for (unsigned int c = 0; c < 3; ++c)
          {
            node.prescribed[c] = text[2 * c] != 0;
            node.may_move[c]   = text[2 * c + 1] != 0;
          }
        for (std::size_t i = 6; i < text.size(); i += 3 + tied_.size())
          node.rows.push_back({Normal({text[i], text[i + 1], text[i + 2]}),
                               std::vector<double>(text.begin() + i + 3, text.begin() + i + 3 + tied_.size())});
      }

      const NodeSpace                       &space_;
      std::vector<const BoundaryCondition *> tied_;
    };

    /// Solves the rows for one free component each (Gauss and Jordan); rows that say nothing new go. What contradicts the others, in words.
    std::string solve(AtNode &node)
    {
      std::vector<Row> solved;
      for (Row row : node.rows)
        {
          for (const Row &before : solved)
            row.subtract(row.a[before.pivot], before);
          for (unsigned int c = 0; c < 3; ++c)
            if (!node.prescribed[c] && (row.pivot < 0 || std::abs(row.a[c]) > std::abs(row.a[row.pivot])))
              row.pivot = static_cast<int>(c);
          if (row.pivot < 0 || std::abs(row.a[row.pivot]) < negligible)
            {
              for (unsigned int c = 0; c < 3; ++c)
                if (node.prescribed[c] && node.may_move[c] && std::abs(row.a[c]) > negligible)
                  return "moves across a symmetry plane, or across a face that moves as one";
              for (const double b : row.b)
                if (std::abs(b) > negligible)
                  return "holds a point of a face that should move as one under a force";
              continue;
            }
          const double scale = 1 / row.a[row.pivot];
          row.subtract(1 - scale, Row(row));
          for (Row &before : solved)
            before.subtract(before.a[row.pivot], row);
          solved.push_back(row);
        }
      node.rows = solved;
      return "";
    }

    /// The names of the conditions on motion that meet at a node.
    std::string names_at(const global_dof_index node, const std::vector<BoundaryCondition> &conditions, const NodeSpace &space)
    {
      std::vector<std::string> names;
      for (const BoundaryCondition &condition : conditions)
        if (condition.prescribes_motion() || condition.constrains())
          if (const auto &on_face = space.face_nodes(condition.face); std::find(on_face.begin(), on_face.end(), node) != on_face.end())
            names.push_back("\"" + condition.name + "\"");
      return join(names, " and ");
    }
  } // namespace

  BoundaryConstraints::BoundaryConstraints(const std::vector<BoundaryCondition> &conditions, const NodeSpace &space)
  {
    Demands     demands(conditions, space);
    std::string problem;
    lines.reinit(space.relevant_unknowns());
    const auto add = [&](const global_dof_index number, AtNode &node) {
      for (unsigned int c = 0; c < 3; ++c)
        if (node.prescribed[c])
          lines.add_line(3 * number + c);
      if (const std::string found = solve(node); !found.empty())
        {
          if (problem.empty() && space.owned_unknowns().is_element(3 * number)) // the owner sees all faces there
            problem = "where " + names_at(number, conditions, space) + " meet, one of them " + found;
          return; // rows that contradict each other are no relations
        }
      for (const Row &row : node.rows)
        {
          std::map<global_dof_index, double> others;
          for (int c = 0; c < 3; ++c)
            if (c != row.pivot)
              others[3 * number + c] -= row.a[c];
          for (std::size_t k = 0; k < row.b.size(); ++k)
            for (unsigned int c = 0; c < 3; ++c)
              others[3 * demands.master(k) + c] += row.b[k] * demands.tied()[k]->direction[c];
          Relation relation{3 * number + row.pivot, {}};
          for (const auto &[index, weight] : others)
            if (std::abs(weight) > negligible)
              relation.others.emplace_back(index, weight);
          lines.add_line(relation.unknown);
          lines.add_entries(relation.unknown, relation.others);
          relations.push_back(relation);
        }
    };
    for (std::size_t k = 0; k < demands.tied().size(); ++k)
      if (const auto found = demands.nodes.find(demands.master(k)); found != demands.nodes.end())
        {
          add(found->first, found->second);
          demands.nodes.erase(found);
        }
    for (auto &[number, node] : demands.nodes)
      add(number, node);
    lines.close();
    held = demands.held;

    for (const std::string &told : dealii::Utilities::MPI::all_gather(space.communicator(), problem))
      if (!told.empty())
        throw InputError(InputProblem{"system/boundary", told, "conditions that agree on the edges where faces meet",
                                      "leave out components of one of them, or \"across\" = \"free\""});
  }
} // namespace myolines
