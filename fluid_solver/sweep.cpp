// One sweep of the remap along an axis. What crosses a face is what lay in the slab that the face has swept: of pure
// cells with a limited linear profile of density and energy per volume (van Leer 1977, J. Comput. Phys. 23:276,
// monotonised central slopes), of shared cells what the plane cuts off the slab, of cells that solids cut their mean at
// the end of the Lagrange phase. Both profiles are non-negative in the whole cell and the slabs at its two faces do not
// overlap: no cell gives more than it has.
#include "fluid_solver/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_solver/pressure_equilibrium.hpp"
#include "fluid_solver/row_geometry.hpp"
#include "fluid_solver/sweep_rows.hpp"

namespace polynya::fluid {
namespace {

/// Rows of four cells in a line, the face between the middle ones; all pointers at the index of the face.
struct Line {
  const double *a, *b, *c, *d;
};

struct Slopes {
  double lower, upper;  ///< width of the donor over the distance of its neighbours' centres
};

/// Limited difference over a cell with differences `one` and `two` to its neighbours: central where that is monotone.
inline double limited(double one, double two, double part) {
  const double central = part * std::abs(one + two), side = 2.0 * std::min(std::abs(one), std::abs(two));
  return one * two > 0 ? std::copysign(std::min(central, side), one) : 0.0;
}

/// Amount that the swept volumes carry, of a quantity per volume.
template <bool masked, class SlopeOf>
void carry(int first, int last, const double* __restrict swept, const double* below, const double* above, Line f,
           Line plain, SlopeOf&& slope_of, double* __restrict out) {
  for (int i = first; i <= last; ++i) {
    const double volume = swept[i];
    const bool forward = volume > 0;
    const double middle = f.c[i] - f.b[i], side = forward ? f.b[i] - f.a[i] : f.d[i] - f.c[i];
    const Slopes part = slope_of(i);
    double reach = 0.5 * (1.0 - std::abs(volume) * (forward ? below[i] : above[i]));
    if (masked) reach *= plain.b[i] * plain.c[i] * (forward ? plain.a[i] : plain.d[i]);
    const double slope = limited(middle, side, forward ? part.lower : part.upper);
    out[i] = volume * (forward ? f.b[i] + reach * slope : f.c[i] - reach * slope);
  }
}

double slope_part(const std::vector<double>& width, int n) {
  return width[n] / (width[n] + 0.5 * (width[n - 1] + width[n + 1]));
}

class Pencil {
 public:
  Pencil(Fluid& fluid, int axis, double dt, SharedCells& shared)
      : fluid_(fluid),
        grid_(fluid.grid),
        axis_(axis),
        dt_(dt),
        shared_(shared),
        width_(static_cast<std::size_t>(grid_.nx) + 3) {
    for (int r = 0; r < (axis == 0 ? 1 : 4); ++r) rows_.emplace_back(width_);
    for (int r = 0; r < (axis == 0 ? 1 : 2); ++r) faces_.emplace_back(width_);
    ones_.assign(width_ + 4, 1.0);
    zeros_.assign(width_ + 4, 0.0);
    if (axis == 0) {
      part_.assign(width_, 0.5);
      for (int i = 1; i <= grid_.nx; ++i) part_[static_cast<std::size_t>(i)] = slope_part(grid_.dx, i);
    }
  }

  /// Along x: one row.
  void run_row(int j, int k) {
    const Span cells = awake_cells(fluid_, j, k);
    if (cells.empty()) return;
    CellRow& row = rows_[0];
    FaceRow& face = faces_[0];
    load(row, {j, k});
    const int n = grid_.nx;
    for (double* array :
         {row.inverse, row.mass[0], row.mass[1], row.energy[0], row.energy[1], row.plain[0], row.plain[1]}) {
      array[-1] = array[0] = array[1];  // beyond the ends the cells repeat: no slope in the outermost
      array[n + 1] = array[n + 2] = array[n];
    }
    const std::ptrdiff_t at = grid_.at(0, j, k);
    const Span faces{cells.first, cells.last + 1};
    for (int i = faces.first; i <= faces.last; ++i) face.swept[i] = dt_ * fluid_.face_rate[0][at + i];
    const auto line = [](const double* f) { return Line{f - 2, f - 1, f, f + 1}; };
    const double* part = part_.data();
    const auto slope_of = [part](int i) { return Slopes{part[i - 1], part[i]}; };
    for (int m = 0; m < 2; ++m) {
      if (!(row.materials >> m & 1)) continue;
      carry_material(row.general, faces.first, faces.last, face, m, row.inverse - 1, row.inverse,
                     line(row.seen_mass[m]), line(row.seen_energy[m]), line(row.seen_plain[m]), slope_of);
      if (row.general) {
        for (int i = faces.first; i <= faces.last; ++i)
          face.volume[m][i] = face.swept[i] * (face.swept[i] > 0 ? row.fraction[m][i - 1] : row.fraction[m][i]);
      }
    }
    for (const int end : {1, n + 1})
      if (faces.holds(end)) inflow(face, row.materials, end, at + (end == 1 ? 0 : end), end == 1);
    if (row.materials == 3) {
      for (int i = faces.first; i <= faces.last; ++i) shared_donor(face, i, at + i, 1);
    }
    finish_faces(face, row.materials, faces, j, k);
    update(row, at, cells, face, face, 1);
  }

  /// Along y or z: all rows of a line of rows, `other` the index of the third axis (k along y, j along z): first
  /// `begin`, then `face` for each row of faces.
  void begin(int other) {
    for (int r = 0; r <= 2; ++r) load(at_row(r), place(r, other));
  }
  int faces_along() const { return (axis_ == 1 ? grid_.ny : grid_.nz) + 1; }
  void face(int f, int other) {
    const int n = faces_along() - 1;
    const auto [j, k] = place(f, other);
    if (f > 1 && f < n + 1) load(at_row(f + 1), place(f + 1, other));
    const bool lowest = f == 1, highest = f == n + 1;
    CellRow &b = at_row(f - 1), &c = at_row(f);
    CellRow &a = f <= 2 ? b : at_row(f - 2), &d = lowest || f >= n ? c : at_row(f + 1);
    FaceRow &face = faces_[f % 2], &before = faces_[(f + 1) % 2];
    const auto [below_j, below_k] = place(f - 1, other);
    const Span below = awake_cells(fluid_, below_j, below_k), faces = hull(below, awake_cells(fluid_, j, k));
    if (faces.empty()) return;
    const std::ptrdiff_t at = grid_.at(0, j, k);
    const double* rate = fluid_.face_rate[axis_].data() + at;
    for (int i = faces.first; i <= faces.last; ++i) face.swept[i] = dt_ * rate[i];
    const int materials = b.materials | c.materials;
    const bool general = a.general || b.general || c.general || d.general;
    const std::vector<double>& widths = axis_ == 1 ? grid_.dy : grid_.dz;
    const Slopes part{lowest ? 0.5 : slope_part(widths, f - 1), highest ? 0.5 : slope_part(widths, f)};
    for (int m = 0; m < 2; ++m) {
      if (!(materials >> m & 1)) continue;
      const auto line = [&](std::array<const double*, 2> CellRow::*of) {
        return Line{(a.*of)[m], (b.*of)[m], (c.*of)[m], (d.*of)[m]};
      };
      carry_material(general, faces.first, faces.last, face, m, b.inverse, c.inverse, line(&CellRow::seen_mass),
                     line(&CellRow::seen_energy), line(&CellRow::seen_plain), [part](int) { return part; });
      if (!general) continue;
      for (int i = faces.first; i <= faces.last; ++i)
        face.volume[m][i] = face.swept[i] * (face.swept[i] > 0 ? b.seen_fraction[m][i] : c.seen_fraction[m][i]);
    }
    if (materials == 3) {
      for (int i = faces.first; i <= faces.last; ++i) shared_donor(face, i, at + i, grid_.stride(axis_));
    }
    finish_faces(face, materials, faces, j, k);
    if (!lowest) update(b, at - grid_.stride(axis_), below, before, face, 0);
  }

 private:
  CellRow& at_row(int r) { return rows_[static_cast<std::size_t>(r % 4)]; }
  std::array<int, 2> place(int r, int other) const {
    return axis_ == 1 ? std::array<int, 2>{r, other} : std::array<int, 2>{other, r};
  }

  void load(CellRow& row, std::array<int, 2> place) {
    const auto [j, k] = place;
    const std::ptrdiff_t at = grid_.at(0, j, k);
    const int n = grid_.nx;
    const bool ghost = j < 1 || k < 1 || j > grid_.ny || k > grid_.nz;
    const std::size_t number = static_cast<std::size_t>(j + (grid_.ny + 3) * k);
    row.materials = ghost ? 3 : materials_around(fluid_, j, k);
    row.general = ghost || row.materials == 3 || fluid_.row_held[number] != 0;
    const Span cells = ghost ? Span{1, n} : near_cells(fluid_, j, k);
    const double* volume = fluid_.sweep_volume.data() + at;
    for (int i = cells.first; i <= cells.last; ++i)
      row.inverse[i] = volume[i] > 0 ? 1.0 / (volume[i] > 0 ? volume[i] : 1.0) : 0.0;
    for (int m = 0; m < 2; ++m) {
      double *mass = row.mass[m], *energy = row.energy[m], *fraction = row.fraction[m], *plain = row.plain[m];
      row.seen_mass[m] = mass;
      row.seen_energy[m] = energy;
      row.seen_fraction[m] = fraction;
      row.seen_plain[m] = plain;
      if (!(row.materials >> m & 1)) {
        row.seen_mass[m] = row.seen_energy[m] = row.seen_fraction[m] = row.seen_plain[m] = zeros_.data() + 2;
        continue;
      }
      const Material& own = fluid_.material[m];
      for (int i = cells.first; i <= cells.last; ++i) {
        mass[i] = own.mass[at + i] * row.inverse[i];
        energy[i] = own.energy[at + i] * row.inverse[i];
      }
      if (!row.general) {
        row.seen_fraction[m] = row.seen_plain[m] = ones_.data() + 2;
        continue;
      }
      const auto& held = fluid_.held;
      for (int i = cells.first; i <= cells.last; ++i) {
        fraction[i] = own.volume[at + i] * row.inverse[i];
        plain[i] = fraction[i] > 1.0 - dormant_fraction ? 1.0 : 0.0;
        if (!ghost && !held[at + i]) continue;
        mass[i] = fluid_.donor[m].mass[at + i];
        energy[i] = fluid_.donor[m].energy[at + i];
        fraction[i] = fluid_.donor[m].volume[at + i];
        plain[i] = 0;
      }
    }
  }

  template <class SlopeOf>
  void carry_material(bool general, int first, int last, FaceRow& face, int m, const double* below, const double* above,
                      Line mass, Line energy, Line plain, SlopeOf&& slope_of) {
    if (general) {
      carry<true>(first, last, face.swept, below, above, mass, plain, slope_of, face.mass[m]);
      carry<true>(first, last, face.swept, below, above, energy, plain, slope_of, face.energy[m]);
    } else {
      carry<false>(first, last, face.swept, below, above, mass, plain, slope_of, face.mass[m]);
      carry<false>(first, last, face.swept, below, above, energy, plain, slope_of, face.energy[m]);
    }
  }

  /// At the ends of a row along x: what flows in has the ambient state, kept in the ghost.
  void inflow(FaceRow& face, int materials, int i, std::ptrdiff_t ghost, bool lower) {
    if (lower ? !(face.swept[i] > 0) : !(face.swept[i] < 0)) return;
    for (int m = 0; m < 2; ++m) {
      if (!(materials >> m & 1)) continue;
      face.mass[m][i] = face.swept[i] * fluid_.donor[m].mass[ghost];
      face.energy[m][i] = face.swept[i] * fluid_.donor[m].energy[ghost];
      face.volume[m][i] = face.swept[i] * fluid_.donor[m].volume[ghost];
    }
  }

  void shared_donor(FaceRow& face, int i, std::ptrdiff_t index, std::ptrdiff_t stride) {
    const double volume = face.swept[i];
    if (volume == 0) return;
    const std::ptrdiff_t donor = volume > 0 ? index - stride : index;
    const std::int32_t label = fluid_.label[donor];
    if (label < 0) return;
    SharedCell& cell = shared_[static_cast<std::size_t>(donor / grid_.sz)][static_cast<std::size_t>(label)];
    const Given given = give(cell, axis_, volume > 0, std::abs(volume), fluid_.sweep_volume[donor]);
    const double sign = volume > 0 ? 1.0 : -1.0;
    for (int m = 0; m < 2; ++m) {
      face.mass[m][i] = sign * given.mass[m];
      face.energy[m][i] = sign * given.energy[m];
      face.volume[m][i] = sign * given.volume[m];
    }
  }

  /// Total masses of a row of faces, and the account of what crosses the outer boundary.
  void finish_faces(FaceRow& face, int materials, Span faces, int j, int k) {
    const std::ptrdiff_t at = grid_.at(0, j, k);
    if (materials == 1) smooth_.faces(fluid_, dt_, axis_, j, k, face.mass[water]);
    double* __restrict total = fluid_.face_mass[axis_].data() + at;
    const double *m0 = face.mass[0], *m1 = face.mass[1];
    if (materials == 3) {
      for (int i = faces.first; i <= faces.last; ++i) total[i] = m0[i] + m1[i];
    } else {
      const double* own = face.mass[materials == 2 ? 1 : 0];
      std::copy(own + faces.first, own + faces.last + 1, total + faces.first);
    }
    const int n = axis_ == 0 ? grid_.nx : axis_ == 1 ? grid_.ny : grid_.nz, r = axis_ == 0 ? 0 : axis_ == 1 ? j : k;
    if (axis_ == 0) {
      if (faces.first == 1) book(face, materials, 0, 1, (j - 1) + static_cast<std::size_t>(grid_.ny) * (k - 1), -1.0);
      if (faces.last == n + 1)
        book(face, materials, 1, n + 1, (j - 1) + static_cast<std::size_t>(grid_.ny) * (k - 1), 1.0);
    } else if (r == 1 || r == n + 1) {
      const int row = axis_ == 1 ? k : j;
      for (int i = faces.first; i <= faces.last; ++i) {
        book(face, materials, 2 * axis_ + (r == 1 ? 0 : 1), i, (i - 1) + static_cast<std::size_t>(grid_.nx) * (row - 1),
             r == 1 ? -1.0 : 1.0);
      }
    }
  }
  void book(const FaceRow& face, int materials, int side, int i, std::size_t place, double outward) {
    if (fluid_.setup.boundary[side] == Boundary::wall) return;
    for (int m = 0; m < 2; ++m) {
      const bool there = materials >> m & 1;
      fluid_.outflow[side][place].mass[m] = there ? outward * face.mass[m][i] : 0.0;
      fluid_.outflow[side][place].energy[m] = there ? outward * face.energy[m][i] : 0.0;
    }
  }

  /// Adds to a row of cells what came through its lower faces less what left through its upper ones (shifted along x).
  void update(const CellRow& row, std::ptrdiff_t at, Span cells, const FaceRow& lower, const FaceRow& upper,
              int shift) {
    const auto add = [&](double* __restrict out, const double* in, const double* gone) {
      for (int i = cells.first; i <= cells.last; ++i) out[i] += in[i] - gone[i + shift];
    };
    for (int m = 0; m < 2; ++m) {
      if (!(row.materials >> m & 1)) continue;
      add(fluid_.material[m].mass.data() + at, lower.mass[m], upper.mass[m]);
      add(fluid_.material[m].energy.data() + at, lower.energy[m], upper.energy[m]);
      if (row.general) add(fluid_.material[m].volume.data() + at, lower.volume[m], upper.volume[m]);
    }
    add(fluid_.sweep_volume.data() + at, lower.swept, upper.swept);
  }

  Fluid& fluid_;
  const Grid& grid_;
  int axis_;
  double dt_;
  SharedCells& shared_;
  std::size_t width_;
  std::vector<CellRow> rows_;
  std::vector<FaceRow> faces_;
  std::vector<double> part_, ones_, zeros_;
  FaceSmoothing smooth_;
};

/// One layer, along x or y.
void sweep_layer(Pencil& pencil, const Grid& grid, int axis, int k) {
  if (axis == 0) {
    for (int j = 1; j <= grid.ny; ++j) pencil.run_row(j, k);
    return;
  }
  pencil.begin(k);
  for (int f = 1; f <= pencil.faces_along(); ++f) pencil.face(f, k);
}

/// True if one of the layers (or planes) begin + 1 to end has cells awake.
bool any_awake(const std::vector<unsigned char>& layers, std::size_t begin, std::size_t end) {
  return std::find(layers.begin() + begin + 1, layers.begin() + end + 1, 1) != layers.begin() + end + 1;
}

/// True for layers no cell of which can be shared while this remap lasts.
std::vector<char> clear_layers(const Fluid& fluid) {
  const Grid& grid = fluid.grid;
  std::vector<char> clear(static_cast<std::size_t>(grid.nz) + 1, 1);
  for (int k = 1; k <= grid.nz; ++k) {
    for (int j = 1; j <= grid.ny && clear[k] && fluid.sleeping.layers[k]; ++j)
      clear[k] = materials_around(fluid, j, k) != 3;
  }
  return clear;
}

}  // namespace

void sweep_layers(Fluid& fluid, int first, int second, double dt, SharedCells& shared) {
  const Grid& grid = fluid.grid;
  const std::size_t layers = static_cast<std::size_t>(grid.nz);
  const std::vector<char> clear = clear_layers(fluid);
  find_shared_cells(fluid, shared);
  compute::for_uneven_chunks(layers, planes_per_chunk(grid.sz), [&](std::size_t begin, std::size_t end) {
    if (!any_awake(fluid.sleeping.layers, begin, end)) return;
    Pencil one(fluid, first, dt, shared), other(fluid, second, dt, shared);
    for (int k = static_cast<int>(begin) + 1; k <= static_cast<int>(end); ++k) {
      if (!fluid.sleeping.layers[k]) continue;
      sweep_layer(one, grid, first, k);
      if (clear[k]) sweep_layer(other, grid, second, k);
    }
  });
  find_shared_cells(fluid, shared);
  compute::for_uneven_chunks(layers, planes_per_chunk(grid.sz), [&](std::size_t begin, std::size_t end) {
    for (int k = static_cast<int>(begin) + 1; k <= static_cast<int>(end); ++k) {
      if (clear[k] || !fluid.sleeping.layers[k]) continue;
      Pencil pencil(fluid, second, dt, shared);
      sweep_layer(pencil, grid, second, k);
    }
  });
}

void sweep(Fluid& fluid, int axis, double dt, SharedCells& shared) {
  const Grid& grid = fluid.grid;
  find_shared_cells(fluid, shared);
  if (axis < 2) {
    compute::for_uneven_chunks(static_cast<std::size_t>(grid.nz), planes_per_chunk(grid.sz),
                               [&](std::size_t begin, std::size_t end) {
                                 if (!any_awake(fluid.sleeping.layers, begin, end)) return;
                                 Pencil pencil(fluid, axis, dt, shared);
                                 for (std::size_t k = begin; k < end; ++k)
                                   sweep_layer(pencil, grid, axis, static_cast<int>(k) + 1);
                               });
    return;
  }
  // Several rows side by side: then what is read from a layer lies together.
  constexpr std::size_t together = 4;
  compute::for_uneven_chunks(static_cast<std::size_t>(grid.ny), together, [&](std::size_t begin, std::size_t end) {
    if (!any_awake(fluid.sleeping.planes, begin, end)) return;
    std::vector<Pencil> pencils;
    for (std::size_t j = begin; j < end; ++j) {
      pencils.emplace_back(fluid, axis, dt, shared);
      pencils.back().begin(static_cast<int>(j) + 1);
    }
    for (int f = 1; f <= grid.nz + 1; ++f) {
      for (std::size_t j = begin; j < end; ++j) pencils[j - begin].face(f, static_cast<int>(j) + 1);
    }
  });
}

}  // namespace polynya::fluid
