#include "coupling/life/announce_daughters.hpp"

#include <array>
#include <cstddef>
#include <span>

#include "core/parallel/ranks.hpp"

namespace acinus::coupling {
namespace {

/// All of a division but the meshes and the reason, whose lengths it has.
struct Announcement {
  std::size_t n_node = 0, n_char = 0;
  double stretch = 1;
  std::array<double, 3> axis{};
  DivisionFigures figures;
  std::uint8_t done = 0;
};

/// Values that each process has of its mothers, by process.
template <class T>
class ByProcess {
 public:
  ByProcess(const Ranks& ranks, const std::vector<T>& own) { ranks.gather<T>(own, all_, &next_); }
  /// Next n values of a process.
  std::span<const T> take(int process, std::size_t n) {
    std::size_t& from = next_[static_cast<std::size_t>(process)];
    from += n;
    return std::span<const T>(all_).subspan(from - n, n);
  }

 private:
  std::vector<T> all_;
  std::vector<std::size_t> next_;
};

}  // namespace

void announce_daughters(const World& world, const std::vector<Cell>& mothers,
                        std::vector<std::uint8_t>& done, std::vector<DaughterMeshes>& daughters,
                        std::vector<std::string>& why) {
  std::vector<Announcement> own;
  std::vector<Vec3> own_node;
  std::vector<char> own_text;
  for (std::size_t k = 0; k < mothers.size(); ++k) {
    if (!is_mine(world, mothers[k])) continue;
    const DaughterMeshes& d = daughters[k];
    Announcement a{0,         why[k].size(), d.stretch, {d.axis.x(), d.axis.y(), d.axis.z()},
                   d.figures, done[k]};
    own_text.insert(own_text.end(), why[k].begin(), why[k].end());
    if (done[k] != 0) {
      a.n_node = d.node[0].size();
      for (const std::vector<Vec3>& node : d.node)
        own_node.insert(own_node.end(), node.begin(), node.end());
    }
    own.push_back(a);
  }
  ByProcess<Announcement> announced(world.ranks, own);
  ByProcess<Vec3> nodes(world.ranks, own_node);
  ByProcess<char> texts(world.ranks, own_text);
  for (std::size_t k = 0; k < mothers.size(); ++k) {
    const int process = process_of(world.state, mothers[k]);
    const Announcement& a = announced.take(process, 1)[0];
    done[k] = a.done;
    const std::span<const char> text = texts.take(process, a.n_char);
    why[k].assign(text.begin(), text.end());
    DaughterMeshes& d = daughters[k];
    d.stretch = a.stretch;
    d.axis = Vec3(a.axis[0], a.axis[1], a.axis[2]);
    d.figures = a.figures;
    for (std::vector<Vec3>& node : d.node) {
      const std::span<const Vec3> values = nodes.take(process, a.n_node);
      node.assign(values.begin(), values.end());
    }
  }
}

}  // namespace acinus::coupling
