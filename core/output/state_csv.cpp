
#include "core/output/state_csv.h"

#include <bit>
#include <vector>

#include "core/fields/particle_field.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"

namespace tyglab {

std::string state_csv(const Tears& tears, const State& state, const StateStamp& stamp) {
  std::string text = "# tyglab state, t = ";
  append_number(text, stamp.t);
  text += ", steps = " + std::to_string(stamp.steps) + ", preset hash " + stamp.preset_hash + "\n";
  text += "i,j,x,y,z,vx,vy,vz\n";
  constexpr std::size_t characters_a_row = 150;  // six numbers of at most 24 characters, and the indices
  text.reserve(text.size() + std::size_t(tears.particles()) * characters_a_row);
  for (int n = 0; n < tears.particles(); ++n) {
    const Pins::Site site = tears.site(n);
    const auto p = std::size_t(n);
    text += std::to_string(site.i) + ',' + std::to_string(site.j);
    for (const VectorField<double>* field : {&state.x, &state.v})
      for (const double value : {field->x[p], field->y[p], field->z[p]}) {
        text += ',';
        append_number(text, value);
      }
    text += '\n';
  }
  return text;
}

std::string state_csv(Simulation& simulation) {
  return state_csv(simulation.tears(), simulation.read_raw(),
                   {simulation.time(), simulation.steps(), preset_hash(simulation.preset())});
}

std::string values_csv(Simulation& cloth, Simulation* reference) {
  std::string text = "# tyglab values, t = ";
  append_number(text, cloth.time());
  text += ", steps = " + std::to_string(cloth.steps()) + ", preset hash " + preset_hash(cloth.preset()) + "\ni,j";
  std::vector<std::vector<float>> columns;
  for (const FieldInfo& field : particle_fields()) {
    const bool of_springs = field.field == ParticleField::tension || field.field == ParticleField::strain;
    if (of_springs && cloth.preset().kind == Kind::one_weight) continue;  // its spring is none of the lattice's
    if (field.field == ParticleField::distance && reference == nullptr) continue;
    text += "," + std::string(field.name) + (field.unit.empty() ? "" : " [" + std::string(field.unit) + "]");
    read_field(field.field, cloth, reference, {cloth.lattice(), 1}, columns.emplace_back());
  }
  text += '\n';
  for (int n = 0; n < cloth.tears().particles(); ++n) {
    const Pins::Site site = cloth.tears().site(n);
    text += std::to_string(site.i) + ',' + std::to_string(site.j);
    for (const auto& column : columns) {
      text += ',';
      append_number(text, double(column[std::size_t(n)]));
    }
    text += '\n';
  }
  return text;
}

namespace {

constexpr std::uint64_t count_offset = 28;  // of the number of samples within the header

/// Appends the four bytes of an int32 or a float32, lowest first, whatever the machine's own order.
template <class T>
void append_little_endian(std::string& bytes, T value) {
  static_assert(sizeof(T) == 4);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
}

}  // namespace

PointCache::PointCache(const std::filesystem::path& file, std::int32_t points)
    : out_(file, OutputFile::Order::any), points_(points) {
  std::string header("POINTCACHE2");
  header.push_back('\0');
  append_little_endian<std::int32_t>(header, 1);
  append_little_endian<std::int32_t>(header, points_);
  append_little_endian<float>(header, 0);
  append_little_endian<float>(header, 1);
  append_little_endian<std::int32_t>(header, 0);
  out_.write(header);
}

void PointCache::add(const VectorField<double>& x) {
  sample_.clear();
  for (std::size_t p = 0; p < std::size_t(points_); ++p)
    for (const double value : {x.x[p], x.y[p], x.z[p]}) append_little_endian(sample_, float_coordinate(value));
  out_.write(sample_);
  ++samples_;
  std::string count;
  append_little_endian(count, samples_);
  out_.write_at(count_offset, count);
  out_.keep();
}

}  // namespace tyglab
