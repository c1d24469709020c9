// Remap of cells: what flowed through each face during the Lagrange phase is moved axis by axis. Sweeps do not commute.
// They go in turns xyz and zyx, so that the error of splitting cancels over two steps, or in all orders from the same
// state, whose mean knows no first axis.
#include <algorithm>

#include "fluid_solver/phases.hpp"
#include "fluid_solver/sweep.hpp"

namespace polynya::fluid {
namespace {

int bits(const Ambient& layer) {
  return (layer.density[0] > 0 ? 1 : 0) | (layer.density[1] > 0 ? 2 : 0);
}

bool encloses(const std::array<Boundary, 6>& boundary, int axis) {
  return boundary[2 * axis] == Boundary::wall && boundary[2 * axis + 1] == Boundary::wall;
}

}  // namespace

int materials_around(const Fluid& fluid, int j, int k) {
  const std::ptrdiff_t width = fluid.grid.ny + 3;
  const unsigned char* row = fluid.row_materials.data() + j + width * k;
  int held = 0;
  for (const std::ptrdiff_t layer : {-width, std::ptrdiff_t{0}, width})
    held |= row[layer - 1] | row[layer] | row[layer + 1];
  const auto& boundary = fluid.setup.boundary;
  if (encloses(boundary, 0) && encloses(boundary, 1) && encloses(boundary, 2)) return held;
  const Ambient* outside = fluid.ambient.data() + k;
  for (const auto& beyond : fluid.beyond) held |= beyond ? bits(beyond->state) : 0;
  return held | bits(outside[-1]) | bits(outside[0]) | bits(outside[1]);
}

namespace {

using Order = std::vector<int>;

void sweep_in_order(Fluid& fluid, const Order& order, double dt, SharedCells& shared) {
  for (std::size_t turn = 0; turn < order.size(); ++turn) {
    if (turn + 1 < order.size() && order[turn] < 2 && order[turn + 1] < 2) {
      sweep_layers(fluid, order[turn], order[turn + 1], dt, shared);
      ++turn;
    } else {
      sweep(fluid, order[turn], dt, shared);
    }
  }
}

/// All that a remap changes: contents of cells, masses through faces, and what left through the outer boundary.
struct Remapped {
  std::vector<std::vector<double>> fields;
  std::array<std::vector<Fluid::Outflow>, 6> outflow;
};

std::vector<std::vector<double>*> fields_of(Fluid& fluid) {
  std::vector<std::vector<double>*> fields{&fluid.sweep_volume};
  for (Material& own : fluid.material) fields.insert(fields.end(), {&own.mass, &own.energy, &own.volume});
  for (auto& masses : fluid.face_mass) fields.push_back(&masses);
  return fields;
}

void sweep_in_all_orders(Fluid& fluid, Order order, double dt, SharedCells& shared) {
  const std::vector<std::vector<double>*> fields = fields_of(fluid);
  Remapped start, mean;
  for (const auto* field : fields) {
    start.fields.push_back(*field);
    mean.fields.emplace_back(field->size(), 0.0);
  }
  for (int side = 0; side < 6; ++side) mean.outflow[side].assign(fluid.outflow[side].size(), {});
  double part = 1;
  for (std::size_t n = 2; n <= order.size(); ++n) part /= static_cast<double>(n);
  std::sort(order.begin(), order.end());
  do {
    for (std::size_t f = 0; f < fields.size(); ++f) *fields[f] = start.fields[f];
    sweep_in_order(fluid, order, dt, shared);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      for (std::size_t c = 0; c < fields[f]->size(); ++c) mean.fields[f][c] += part * (*fields[f])[c];
    }
    for (int side = 0; side < 6; ++side) {
      for (std::size_t face = 0; face < mean.outflow[side].size(); ++face) {
        for (int m = 0; m < 2; ++m) {
          mean.outflow[side][face].mass[m] += part * fluid.outflow[side][face].mass[m];
          mean.outflow[side][face].energy[m] += part * fluid.outflow[side][face].energy[m];
        }
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  for (std::size_t f = 0; f < fields.size(); ++f) *fields[f] = mean.fields[f];
  fluid.outflow = mean.outflow;
}

}  // namespace

void remap_cells(Fluid& fluid, double dt) {
  mirror_pressure(fluid);
  SharedCells shared;
  const Grid& grid = fluid.grid;
  const std::array<int, 3> cells{grid.nx, grid.ny, grid.nz};
  Order order;
  for (int turn = 0; turn < 3; ++turn) {
    const int axis = fluid.steps % 2 == 0 ? turn : 2 - turn;
    if (cells[axis] > 1 || !encloses(fluid.setup.boundary, axis)) order.push_back(axis);
  }
  if (fluid.setup.sweeps == Sweeps::all_orders)
    sweep_in_all_orders(fluid, order, dt, shared);
  else
    sweep_in_order(fluid, order, dt, shared);
  forget_shared_cells(fluid);
}

}  // namespace polynya::fluid
