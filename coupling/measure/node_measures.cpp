#include "coupling/measure/node_measures.hpp"

#include "coupling/measure/cell_numbers.hpp"
#include "coupling/measure/gather_parts.hpp"
#include "dcm/group_view.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/loads/stress.hpp"

namespace acinus::coupling {
namespace {

/// Contact forces on the nodes of own cells, [rows][3][lane] nN.
RowVector<double> sum_contact_forces(const World& world, const Workspace& w) {
  RowVector<double> contact;
  set_size(contact, world.state.dcm.position.size());
  solve::clear_own_rows(w.system, kPointStride, contact);
  const solve::Links& links = w.system.links;
  for (std::size_t l = 0; l < links.size(); ++l) {
    const contact::Contact& k = w.contacts.all[links.law[l].contact];
    if (k.partner == contact::Partner::kNucleus) continue;
    const solve::Stencil stencil = solve::stencil_of(links.link[l]);
    const Vec3 f = k.force * k.normal;
    for (int m = 0; m < stencil.n; ++m)
      if (stencil.address[m] < contact.size())
        add_point(contact.data(), stencil.address[m], stencil.weight[m] * f);
  }
  return contact;
}

void pack_nodes(const World& world, const Workspace& w, const RowVector<double>& contact,
                std::size_t body, std::vector<NodeValue>& out) {
  const State& s = world.state;
  const std::size_t lane = w.dcm.lane_of_body[body];
  const dcm::Group& group = s.dcm.group[lane / kLanes];
  const dcm::GroupView g = dcm::view_group(s.dcm, w.lanes, w.system, lane / kLanes);
  const auto tension =
      dcm::compute_node_tension(w.dcm_params[group.type], g, static_cast<int>(lane % kLanes));
  const double r2 = w.lanes.radius[lane] * w.lanes.radius[lane];
  for (int i = 0; i < group.topology->n_node; ++i) {
    const std::size_t k = i;
    const Address at = dcm::node_address(s.dcm, lane, i);
    const Vec3 f = load_point(contact.data(), at);
    out.push_back(
        {load_point(s.dcm.position.data(), at), f,
         -f.dot(w.dcm.body[body].node_normal[k]) / (group.topology->rest_node_area[k] * r2),
         tension[k]});
  }
}

}  // namespace

void visit_nodes(const World& world, const Workspace& w,
                 const std::function<void(std::span<const NodeValue>)>& take) {
  const CellNumbers numbers = number_cells(world.state, w);
  const RowVector<double> contact = sum_contact_forces(world, w);
  std::size_t body = 0;  // bodies are in the order of cells
  gather_parts<NodeValue>(
      world.ranks, numbers, w,
      [&](std::size_t k) {
        const dcm::Group& group = world.state.dcm.group[numbers.lane[k] / kLanes];
        return static_cast<std::size_t>(group.topology->n_node);
      },
      [&](std::size_t k, std::vector<NodeValue>& out) {
        while (numbers.of_body[body] != k) ++body;
        pack_nodes(world, w, contact, body, out);
      },
      take);
}

void visit_nuclei(const World& world, const Workspace& w,
                  const std::function<void(std::span<const Vec3>)>& take) {
  const dcm::State& s = world.state.dcm;
  if (!dcm::has_nuclei(s)) return;
  const CellNumbers numbers = number_cells(world.state, w);
  std::vector<Vec3> node;
  gather_parts<Vec3>(
      world.ranks, numbers, w,
      [&](std::size_t k) {
        return static_cast<std::size_t>(s.group[numbers.lane[k] / kLanes].nucleus.n_node());
      },
      [&](std::size_t k, std::vector<Vec3>& out) {
        if (!s.group[numbers.lane[k] / kLanes].nucleus.exists()) return;
        dcm::copy_nucleus(s, numbers.lane[k], node);
        out.insert(out.end(), node.begin(), node.end());
      },
      take);
}

NodeMeasure measure_nodes(const World& world, const Workspace& w) {
  NodeMeasure all;
  visit_nodes(world, w, [&all](std::span<const NodeValue> nodes) {
    for (const NodeValue& n : nodes) {
      all.force.push_back(n.force);
      all.pressure.push_back(n.pressure);
      all.tension.push_back(n.tension);
    }
  });
  return all;
}

}  // namespace acinus::coupling
