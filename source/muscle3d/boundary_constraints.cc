// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/muscle3d/discretisation.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace myolines
{
  namespace
  {
    using dealii::types::global_dof_index;

    constexpr double negligible = 1e-10; ///< beside 1

    /// sum over c of a_c u_c = sum over k of b_k q_k at a node, q_k what moves face k.
    struct Row
    {
      Vector3             a;
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

    /// What all conditions ask of the nodes that this rank sees, and of those that all ranks know.
    class Demands
    {
    public:
      Demands(const BoundaryConditions &conditions, const NodeSpace &space)
        : space_(space)
      {
        for (const auto &condition : conditions)
          if (condition->facts().moves_as_one)
            masters_.push_back(space_.shared_nodes().at(condition->facts().face));
        for (const auto &condition : conditions)
          {
            if (condition->facts().prescribes())
              prescribe(condition->facts());
            if (condition->facts().ties)
              tie(*condition);
          }
        share();
      }

      std::map<global_dof_index, AtNode>         nodes;
      std::map<std::string, std::array<bool, 3>> held;
      const std::vector<global_dof_index>       &masters() const { return masters_; }
      const Vector3                             &direction(const std::size_t k) const { return directions_[k]; } ///< of the motion q_k

    private:
      void prescribe(const BoundaryFacts &condition)
      {
        for (const auto node : space_.face_nodes(condition.face))
          for (unsigned int c = 0; c < 3; ++c)
            if (condition.prescribed[c])
              {
                nodes[node].prescribed[c] = true;
                nodes[node].may_move[c]   = condition.moving[c]; // the later condition holds
              }
      }

      void tie(const BoundaryCondition &condition)
      {
        for (const Tie &tie : condition.ties(space_))
          {
            const std::size_t k = directions_.size();
            Row               row{tie.direction, std::vector<double>(masters_.size())};
            for (unsigned int c = 0; c < 3; ++c)
              held[condition.facts().name][c] = held[condition.facts().name][c] || std::abs(row.a[c]) > negligible;
            if (tie.moves)
              {
                row.b[k] = 1;
                directions_.push_back(tie.direction);
              }
            for (const auto node : space_.face_nodes(condition.facts().face))
              if (!tie.moves || node != masters_[k]) // whose motion is q
                nodes[node].rows.push_back(row);
          }
      }

      /// Tells all ranks of the nodes that all know.
      void share()
      {
        for (const global_dof_index master : masters_)
          {
            std::vector<double> text;
            if (const auto found = nodes.find(master); found != nodes.end() && space_.owned_unknowns().is_element(3 * master))
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
                hear(master, told);
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
        for (std::size_t i = 6; i < text.size(); i += 3 + masters_.size())
          node.rows.push_back({Vector3({text[i], text[i + 1], text[i + 2]}),
                               std::vector<double>(text.begin() + i + 3, text.begin() + i + 3 + masters_.size())});
      }

      const NodeSpace              &space_;
      std::vector<global_dof_index> masters_;    ///< by face that moves as one
      std::vector<Vector3>          directions_; ///< likewise
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
    std::string names_at(const global_dof_index node, const BoundaryConditions &conditions, const NodeSpace &space)
    {
      std::vector<std::string> names;
      for (const auto &condition : conditions)
        if (condition->facts().constrains())
          if (const auto &on_face = space.face_nodes(condition->facts().face);
              std::find(on_face.begin(), on_face.end(), node) != on_face.end())
            names.push_back("\"" + condition->facts().name + "\"");
      return join(names, " and ");
    }
  } // namespace

  BoundaryConstraints::BoundaryConstraints(const BoundaryConditions &conditions, const NodeSpace &space)
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
              others[3 * demands.masters()[k] + c] += row.b[k] * demands.direction(k)[c];
          Relation relation{3 * number + row.pivot, {}};
          for (const auto &[index, weight] : others)
            if (std::abs(weight) > negligible)
              relation.others.emplace_back(index, weight);
          lines.add_line(relation.unknown);
          lines.add_entries(relation.unknown, relation.others);
          relations.push_back(relation);
        }
    };
    for (const global_dof_index master : demands.masters())
      if (const auto found = demands.nodes.find(master); found != demands.nodes.end())
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
