// SPDX-License-Identifier: LGPL-2.1-or-later
#include "abaqus_kinds.h"
#include "abaqus_motion.h"
#include "formats.h"

#include <cmath>
#include <set>
#include <utility>

namespace myolines
{
  namespace
  {
    using Shape = PlainMesh::Shape;

    std::string_view without_blanks(std::string_view text)
    {
      const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
      return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
    }

    /// What stands between commas; nothing behind the last one.
    std::vector<std::string_view> words_of(std::string_view line)
    {
      std::vector<std::string_view> words;
      while (!line.empty())
        {
          const std::size_t comma = std::min(line.find(','), line.size());
          words.push_back(without_blanks(line.substr(0, comma)));
          line.remove_prefix(std::min(comma + 1, line.size()));
        }
      return words;
    }

    class AbaqusReader
    {
    public:
      explicit AbaqusReader(Cursor &cursor)
        : cursor_(cursor)
        , builder_(cursor, mesh_)
      {}

      PlainMesh read()
      {
        mesh_.format = "Abaqus";
        while (cursor_.left() > 0)
          {
            const std::string_view line = without_blanks(cursor_.line());
            if (line.empty() || line.substr(0, 2) == "**")
              continue;
            if (line.front() == '*')
              keyword(whole_keyword(line));
            else
              data(line);
          }
        if (!element_.empty())
          cursor_.refuse("the last element has only " + std::to_string(element_.size() - 1) + " nodes: the file is cut off",
                         std::to_string(kind_.n_nodes));
        add_elements();
        add_surfaces();
        for (PlainMesh::Position &x : mesh_.points)
          x = motion_.of(x);
        return std::move(mesh_);
      }

    private:
      struct Element
      {
        Shape                       shape;
        bool                        straight;
        std::array<std::int64_t, 8> corners;
        std::set<int>               groups; ///< places in names_of_sets_
      };

      /// A keyword whose line ends with a comma goes on in the next one.
      std::string whole_keyword(const std::string_view first)
      {
        std::string all(first);
        while (all.back() == ',' && cursor_.left() > 0)
          all += " " + std::string(without_blanks(cursor_.line()));
        return all;
      }

      /// Refuses what would make other nodes and elements than those that stand in the file.
      void refuse_what_is_not_read()
      {
        static const std::set<std::string> makers{"*INCLUDE", "*SYSTEM", "*NGEN",   "*NFILL", "*NCOPY",
                                                  "*NMAP",    "*ELGEN",  "*ELCOPY", "*IMPORT"};
        const std::string                  hint = "write the mesh out as one input file";
        if (makers.count(keyword_) > 0)
          cursor_.refuse("the keyword " + keyword_ + " is not read", "a file that has all nodes and elements itself", hint);
        const bool of_mesh = keyword_ == "*NODE" || keyword_ == "*ELEMENT" || keyword_ == "*NSET" || keyword_ == "*ELSET";
        if (of_mesh && options_.count("INPUT") > 0)
          cursor_.refuse(keyword_ + " takes its data from the file \"" + options_["INPUT"].substr(0, 40) + "\"",
                         "a file that has all nodes and elements itself", hint);
        if (keyword_ == "*NODE" && options_.count("SYSTEM") > 0 && upper(options_["SYSTEM"]) != "R")
          cursor_.refuse("the nodes are in the coordinate system \"" + options_["SYSTEM"].substr(0, 40) + "\"",
                         "rectangular coordinates, SYSTEM=R", hint);
      }

      void keyword(const std::string_view line)
      {
        if (!element_.empty())
          cursor_.refuse("the last element has only " + std::to_string(element_.size() - 1) + " nodes", std::to_string(kind_.n_nodes));
        options_.clear();
        const std::vector<std::string_view> words = words_of(line);
        keyword_                                  = upper(std::string(words[0]));
        for (const std::string_view word : words)
          {
            const std::size_t equals = word.find('=');
            options_[upper(std::string(without_blanks(word.substr(0, equals))))] =
                equals == std::string_view::npos ? "" : std::string(without_blanks(word.substr(equals + 1)));
          }
        refuse_what_is_not_read();
        if (keyword_ == "*INSTANCE" && ++n_instances_ > 1)
          cursor_.refuse("there are several instances of parts", "one", "merge the parts");
        if (keyword_ == "*INSTANCE")
          instance_ = upper(options_["NAME"]);
        if (keyword_ == "*PART")
          part_is_new_ = true;
        if (keyword_ == "*NODE" && std::exchange(part_is_new_, false) && ++n_parts_ > 1)
          cursor_.refuse("there are nodes of several parts", "one part", "merge the parts, or leave out those without an instance");
        if (keyword_ == "*ASSEMBLY" || keyword_ == "*END ASSEMBLY" || keyword_ == "*INSTANCE" || keyword_ == "*END INSTANCE")
          beside_the_instance_ = keyword_ == "*ASSEMBLY" || keyword_ == "*END INSTANCE";
        if (keyword_ == "*NODE" && beside_the_instance_)
          keyword_ = "*OTHER"; // a point of reference, with a number of its own
        if (keyword_ == "*ELEMENT")
          kind_ = abaqus_kind(upper(options_["TYPE"]), cursor_);
        if (keyword_ == "*ELEMENT" && !kind_.shape)
          keyword_ = "*OTHER";
        if (keyword_ == "*SURFACE" && upper(options_["TYPE"]) == "NODE")
          keyword_ = "*OTHER";
      }

      void data(const std::string_view line)
      {
        if (keyword_ == "*NODE")
          read_node(words_of(line));
        else if (keyword_ == "*ELEMENT")
          read_element(words_of(line));
        else if (keyword_ == "*ELSET")
          read_set(words_of(line), element_sets_[name_of("ELSET")]);
        else if (keyword_ == "*NSET")
          read_set(words_of(line), node_sets_[name_of("NSET")]);
        else if (keyword_ == "*SURFACE")
          read_surface(words_of(line));
        else if (keyword_ == "*INSTANCE")
          read_motion(words_of(line));
      }

      std::string name_of(const std::string &option)
      {
        if (options_[option].empty())
          cursor_.refuse(keyword_ + " has no name", option + "=NAME");
        return first_spelling(options_[option]);
      }

      /// Names without quotation marks are equal in any case: as it was written where it came first.
      std::string first_spelling(const std::string_view name)
      {
        if (name.size() > 1 && name.front() == '"' && name.back() == '"')
          return std::string(name.substr(1, name.size() - 2));
        return spellings_.emplace(upper(std::string(name)), name).first->second;
      }

      /// Without the name of the instance and a point in front, as sets and surfaces of the assembly have them.
      std::string_view without_instance(const std::string_view word) const
      {
        const std::size_t n         = instance_.size();
        const bool        qualified = n > 0 && word.size() > n + 1 && word[n] == '.' && upper(std::string(word.substr(0, n))) == instance_;
        return qualified ? word.substr(n + 1) : word;
      }

      std::int64_t integer(const std::string_view word, const std::string &what) const
      {
        const double value = number_of(word);
        if (!(std::abs(value) < 1e15) || value != std::floor(value))
          cursor_.refuse("\"" + std::string(word.substr(0, 40)) + "\" stands where " + what + " should be", "an integer");
        return static_cast<std::int64_t>(value);
      }

      double finite(const std::string_view word, const std::string &what) const
      {
        const double value = number_of(word);
        if (!std::isfinite(value))
          cursor_.refuse("\"" + std::string(word.substr(0, 40)) + "\" stands where " + what + " should be", "a number");
        return value;
      }

      void read_motion(const std::vector<std::string_view> &words)
      {
        std::vector<double> numbers;
        for (const std::string_view word : words)
          numbers.push_back(finite(word, "a number of a motion"));
        motion_.add(numbers, cursor_);
      }

      void read_node(const std::vector<std::string_view> &words)
      {
        if (words.size() < 4)
          cursor_.refuse("a node has " + std::to_string(words.size()) + " numbers", "its number and three coordinates");
        PlainMesh::Position x;
        for (std::size_t c = 0; c < 3; ++c)
          x[c] = finite(words[c + 1], "a coordinate");
        const std::int64_t number = integer(words[0], "the number of a node");
        builder_.add_point(number, x);
        if (options_.count("NSET") > 0)
          node_sets_[name_of("NSET")].push_back(number);
      }

      /// An element may go over several lines.
      void read_element(const std::vector<std::string_view> &words)
      {
        for (const std::string_view word : words)
          element_.push_back(integer(word, element_.empty() ? "the number of an element" : "a node of an element"));
        if (element_.size() > kind_.n_nodes + 1)
          cursor_.refuse("an element has " + std::to_string(element_.size() - 1) + " nodes", std::to_string(kind_.n_nodes));
        if (element_.size() < kind_.n_nodes + 1)
          return;
        Element element{*kind_.shape, kind_.n_nodes == n_corners(*kind_.shape), {}, {}};
        for (std::size_t i = 0; i < n_corners(*kind_.shape); ++i)
          element.corners[i] = element_[i + 1];
        if (!elements_.emplace(element_[0], element).second)
          cursor_.refuse("the element " + std::to_string(element_[0]) + " is there twice", "one element for each number");
        if (options_.count("ELSET") > 0)
          element_sets_[name_of("ELSET")].push_back(element_[0]);
        element_.clear();
      }

      /// Numbers and names of other sets, or first, last and increment.
      void read_set(const std::vector<std::string_view> &words, std::vector<std::int64_t> &set)
      {
        if (options_.count("GENERATE") > 0)
          {
            const auto first = integer(words[0], "the first of a set"),
                       last  = integer(words.size() > 1 ? words[1] : words[0], "the last of a set");
            const auto step  = words.size() > 2 ? integer(words[2], "the increment of a set") : 1;
            if (step < 1 || last < first || (last - first) / step > static_cast<std::int64_t>(cursor_.bytes().size()))
              cursor_.refuse("a set goes from " + std::to_string(first) + " to " + std::to_string(last) + " by " + std::to_string(step),
                             "no more than the file may have");
            for (std::int64_t i = first; i <= last; i += step)
              set.push_back(i);
            return;
          }
        for (const std::string_view word : words)
          if (!word.empty())
            {
              auto                  &sets  = keyword_ == "*NSET" ? node_sets_ : element_sets_;
              const std::string_view local = without_instance(word);
              const auto             other = std::isfinite(number_of(local)) ? sets.end() : sets.find(first_spelling(local));
              if (other != sets.end() && &other->second != &set)
                set.insert(set.end(), other->second.begin(), other->second.end());
              else
                set.push_back(integer(local, "a number of a set"));
            }
      }

      void read_surface(const std::vector<std::string_view> &words)
      {
        if (!words.empty() && !words[0].empty())
          surfaces_.emplace_back(
              name_of("NAME"), std::pair(first_spelling(without_instance(words[0])), words.size() > 1 ? upper(std::string(words[1])) : ""));
      }

      /// Groups are numbered in the order of their names.
      void add_elements()
      {
        int number = 0;
        for (const auto &[name, set] : element_sets_)
          {
            ++number;
            for (const std::int64_t one : set)
              if (const auto element = elements_.find(one); element != elements_.end())
                {
                  element->second.groups.insert(number);
                  (faces_of(element->second.shape).empty() ? mesh_.face_groups : mesh_.cell_groups)[number] = name;
                }
          }
        for (const auto &[number_of_element, element] : elements_)
          {
            const bool cell = !faces_of(element.shape).empty();
            if (cell && !element.straight)
              ++mesh_.straightened;
            const std::vector<std::int64_t> corners(element.corners.begin(), element.corners.end());
            if (cell || !element.groups.empty())
              builder_.add(element.shape, {element.groups.begin(), element.groups.end()}, corners);
          }
      }

      void add_surfaces()
      {
        int                        number = static_cast<int>(element_sets_.size());
        std::map<std::string, int> numbers;
        for (const auto &[name, part] : surfaces_)
          {
            const auto [entry, fresh] = numbers.emplace(name, number + 1);
            number += fresh ? 1 : 0;
            mesh_.face_groups[entry->second] = name;
            const auto set                   = element_sets_.find(part.first);
            if (set != element_sets_.end())
              for (const std::int64_t element : set->second)
                add_side(element, part.second, entry->second);
            else
              add_side(integer(part.first, "a set or an element of a surface"), part.second, entry->second);
          }
        if (mesh_.faces.empty())
          add_node_sets(number);
      }

      void add_side(const std::int64_t number, const std::string &side, const int group)
      {
        const auto found = elements_.find(number);
        if (found == elements_.end())
          cursor_.refuse("a surface has the element " + std::to_string(number) + ", which is not in the file", "a number of an element");
        const Element &element = found->second;
        const auto    &faces   = faces_of(element.shape);
        if (faces.empty())
          return builder_.add(element.shape, {group}, {element.corners.begin(), element.corners.end()});
        if (side.empty())
          return add_free_sides(element, group);
        const std::size_t f = side.size() == 2 && side[0] == 'S' ? static_cast<std::size_t>(side[1] - '1') : faces.size();
        if (f >= faces.size())
          cursor_.refuse("\"" + side + "\" is no side of the element " + std::to_string(number), "S1 to S" + std::to_string(faces.size()));
        add_side(element, faces[f], group);
      }

      void add_side(const Element &element, const std::vector<unsigned int> &side, const int group)
      {
        std::vector<std::int64_t> corners;
        for (const unsigned int i : side)
          corners.push_back(element.corners[i]);
        builder_.add(corners.size() == 3 ? Shape::triangle : Shape::quadrilateral, {group}, corners);
      }

      /// Those that belong to no other element.
      void add_free_sides(const Element &element, const int group)
      {
        if (outer_.empty())
          for (const PlainMesh::Element &face : outer_faces(mesh_))
            outer_.insert(face_key(face));
        for (const auto &side : faces_of(element.shape))
          {
            PlainMesh::Element face{side.size() == 3 ? Shape::triangle : Shape::quadrilateral, group, {}};
            for (std::size_t i = 0; i < side.size(); ++i)
              face.corner[i] = *builder_.place(element.corners[side[i]]);
            if (outer_.count(face_key(face)) > 0)
              add_side(element, side, group);
          }
      }

      /// Without surfaces, sets of nodes name the faces of the boundary all of whose corners they have.
      void add_node_sets(int number)
      {
        const std::vector<PlainMesh::Element> outer = outer_faces(mesh_);
        for (const auto &[name, set] : node_sets_)
          {
            std::set<unsigned int> places;
            for (const std::int64_t node : set)
              if (const auto place = builder_.place(node))
                places.insert(*place);
            std::vector<PlainMesh::Element> found;
            for (PlainMesh::Element face : outer)
              if (std::all_of(face.corner.begin(), face.corner.begin() + n_corners(face.shape),
                              [&](const unsigned int v) { return places.count(v) > 0; }))
                {
                  face.group = number + 1;
                  found.push_back(face);
                }
            if (found.empty() || found.size() == outer.size())
              continue;
            mesh_.face_groups[++number] = name;
            mesh_.faces.insert(mesh_.faces.end(), found.begin(), found.end());
          }
      }

      Cursor                                                                  &cursor_;
      PlainMesh                                                                mesh_;
      MeshBuilder                                                              builder_;
      std::string                                                              keyword_;
      std::map<std::string, std::string>                                       options_; ///< of the keyword
      AbaqusKind                                                               kind_{};
      std::vector<std::int64_t>                                                element_; ///< number and nodes, as far as they are read
      std::map<std::int64_t, Element>                                          elements_;
      std::map<std::string, std::vector<std::int64_t>>                         element_sets_, node_sets_;
      std::vector<std::pair<std::string, std::pair<std::string, std::string>>> surfaces_;  ///< name; set or element, and side
      std::set<FaceKey>                                                        outer_;     ///< once they are asked for
      std::map<std::string, std::string>                                       spellings_; ///< of names, by their capital letters
      std::string                                                              instance_;  ///< its name in capital letters
      unsigned int                                                             n_instances_ = 0, n_parts_ = 0;
      bool                                                                     part_is_new_ = false;         ///< it has no nodes yet
      AbaqusMotion                                                             motion_;                      ///< of the instance
      bool                                                                     beside_the_instance_ = false; ///< in the assembly
    };
  } // namespace

  PlainMesh read_abaqus(Cursor &cursor) { return AbaqusReader(cursor).read(); }
} // namespace myolines
