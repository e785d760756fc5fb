#include "solver/field.hpp"

#include "mesh/neighbour_exchange.hpp"

namespace cobasis {

void Fields::complete(std::int32_t cell) {
  CellList one(pack_width);
  one.push(cell);
  one.fill(pack_width);
  complete(one, 1);
}

COBASIS_KERNEL void Fields::complete(const CellList& cells, std::int32_t n) {
  const Pack zero(0.0), one(1.0);
  for (std::int32_t i = 0; i < n; i += pack_width) {
    const Indices<Pack> at = load_indices<Pack>(&cells[i]);
    // The void, or else the first of the largest phases, takes the rest.
    Pack largest(-infinity), others(0.0);
    for (const Phase& phase : phases)
      largest = larger(largest, phase.is_void ? Pack(infinity) : gather<Pack>(phase.alpha.data(), at));
    Pack::mask_type found(false);
    Pack present(0.0), only(-1.0);
    for (int k = 0; k < n_phases(); ++k) {
      const Pack alpha = gather<Pack>(phases[k].alpha.data(), at);
      const Pack::mask_type rest = !found && (phases[k].is_void ? Pack(infinity) : alpha) == largest;
      found = found || rest;
      const Pack::mask_type there = !rest && alpha != zero;
      others += select(rest, zero, alpha);
      present += select(there, one, zero);
      only = select(there, Pack(static_cast<double>(k)), only);
    }
    const Pack remainder = one - others;
    found = Pack::mask_type(false);
    for (int k = 0; k < n_phases(); ++k) {
      const Pack alpha = gather<Pack>(phases[k].alpha.data(), at);
      const Pack::mask_type rest = !found && (phases[k].is_void ? Pack(infinity) : alpha) == largest;
      found = found || rest;
      scatter(select(rest, remainder, alpha), phases[k].alpha.data(), at);
      const Pack::mask_type there = rest && remainder != zero;
      present += select(there, one, zero);
      only = select(there, Pack(static_cast<double>(k)), only);
    }
    Pack fraction(0.0);  // of the phase named last
    for (int k = 0; k < n_phases(); ++k)
      fraction = select(only == Pack(static_cast<double>(k)), gather<Pack>(phases[k].alpha.data(), at), fraction);
    only = select(present == one && fraction == one, only, Pack(-1.0));
    for (int j = 0; j < pack_width; ++j) pure[at[j]] = static_cast<std::int32_t>(lane(only, j));
  }
}

void Fields::share_alpha(const Mesh& mesh, NeighbourExchange& exchange) {
  exchange_cells(exchange, mesh.neighbours, [&](std::int32_t cell, const auto& with) {
    for (Phase& phase : phases) with(phase.alpha[cell]);
  });
}

}  // namespace cobasis
