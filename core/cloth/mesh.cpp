#include "core/cloth/mesh.h"

#include <bit>

namespace tyglab {

std::vector<int> Mesh::parted_sites() const {
  std::vector<int> all;
  all.reserve(fans_.size());
  for (int site = 0; site < sites_.size(); ++site)
    if (parted(site)) all.push_back(site);
  return all;
}

unsigned Mesh::cells_at(const Lattice& sites, int site) {
  const int i = site / sites.columns, j = site % sites.columns;
  unsigned cells = all_cells;
  if (i == 0) cells &= ~unsigned(up_left | up_right);
  if (i + 1 == sites.rows) cells &= ~unsigned(down_left | down_right);
  if (j == 0) cells &= ~unsigned(up_left | down_left);
  if (j + 1 == sites.columns) cells &= ~unsigned(up_right | down_right);
  return cells;
}

unsigned Mesh::cells_of(int particle) const {
  const int site = this->site(particle);
  const unsigned all = cells_at(site);
  if (!parted(site)) return all;
  unsigned own = 0;
  for (int cell = 0; cell < cells_round; ++cell)
    if ((all >> cell & 1) != 0 && holder(site, cell) == particle) own |= 1u << cell;
  return own;
}

int Mesh::holder(int site, int cell) const {
  assert(cell >= 0 && cell < cells_round);
  return parted(site) ? fans_[std::size_t(fan_of_[std::size_t(site)])][std::size_t(cell)] : site;
}

double Mesh::share(int particle) const {
  const int site = this->site(particle);
  return parted(site) ? double(std::popcount(cells_of(particle))) / std::popcount(cells_at(site)) : 1;
}

int Mesh::part(int particle, unsigned cells) {
  const int site = this->site(particle), copy = particles();
  assert((cells & ~cells_of(particle)) == 0 && cells != 0 && cells != cells_of(particle));
  site_of_.push_back(site);
  std::int32_t& fan = fan_of_[std::size_t(site)];
  if (fan < 0) {
    fan = std::int32_t(fans_.size());
    fans_.push_back({site, site, site, site});
  }
  for (int cell = 0; cell < cells_round; ++cell)
    if ((cells >> cell & 1) != 0) fans_[std::size_t(fan)][std::size_t(cell)] = copy;
  return copy;
}

}  // namespace tyglab
