#include "core/output/series_csv.h"

#include <algorithm>

#include "core/io/preset_io.h"
#include "core/io/terminal.h"

namespace tyglab {

std::string series_head(std::span<const SeriesColumn> columns, const std::string& about) {
  std::string head = "# tyglab series, t in s, " + about + "\nt";
  for (const SeriesColumn& column : columns) {
    head += ',' + column.name;
    if (!column.unit.empty()) head += " [" + column.unit + ']';
  }
  return head + '\n';
}

void append_series_row(std::string& text, double t, std::span<const double> values) {
  append_number(text, t, 17);
  for (const double value : values) {
    text += ',';
    append_number(text, value, 9);
  }
  text += '\n';
}

SeriesCsv::SeriesCsv(const std::filesystem::path& file, std::span<const SeriesColumn> columns,
                     const std::string& preset_hash)
    : out_(file) {
  out_.write(series_head(columns, "preset hash " + preset_hash));
}

void SeriesCsv::add(double t, std::span<const double> values) {
  row_.clear();
  append_series_row(row_, t, values);
  out_.write(row_);
  out_.keep();
}

std::vector<SeriesColumn> series_columns(Kind kind) {
  if (kind == Kind::one_weight) return {{"y", "m"}, {"v", "m/s"}, {"E_kin", "J"}};
  return {{"E_kin", "J"},   {"y_mean", "m"},  {"y_min", "m"}, {"y_max", "m"},   {"sum_F_s", "N"},
          {"sum_F_b", "N"}, {"sum_F_d", "N"}, {"sum_F", "N"}, {"max_F_s", "N"}, {"max_F_b", "N"},
          {"max_F_d", "N"}, {"max_F", "N"},   {"torn", ""}};
}

std::vector<double> series_values(Simulation& simulation) {
  const State& state = simulation.read();
  const Preset& preset = simulation.preset();
  const Tears& tears = simulation.tears();
  const auto particles = std::size_t(tears.particles());
  double squares = 0;
  for (const auto* v : {&state.v.x, &state.v.y, &state.v.z})
    for (std::size_t n = 0; n < particles; ++n) squares += tears.share(int(n)) * (*v)[n] * (*v)[n];
  const double E_kin = 0.5 * preset.m * squares;

  const Array<double>& y = state.x.y;
  if (preset.kind == Kind::one_weight) return {y[0], state.v.y[0], E_kin};
  double sum = 0;
  for (std::size_t n = 0; n < particles; ++n) sum += tears.share(int(n)) * y[n];
  const auto [lowest, highest] = std::minmax_element(y.begin(), y.begin() + std::ptrdiff_t(particles));
  const double mean = sum / double(tears.lattice().sites().size()), y_min = *lowest, y_max = *highest;
  const ForceSummary total = simulation.forces(Reduction::sum), most = simulation.forces(Reduction::maximum);
  return {E_kin,
          mean,
          y_min,
          y_max,
          total["F_s"],
          total["F_b"],
          total["F_d"],
          total["F"],
          most["F_s"],
          most["F_b"],
          most["F_d"],
          most["F"],
          double(simulation.tears().torn_count())};
}

namespace {

/// Calls visit(name, value) for each entry of the ledger: energies, works, and what no force explains.
template <class Visit>
void for_each_entry(const LedgerReading& r, const Visit& visit) {
  const auto works = [&](Force::Group group) {
    for (const Force* force : force::all)
      if (!force->conserves && force->group == group) visit(force->name, r.works.of[*force]);
  };
  visit("kinetic", r.energy.kinetic);
  for (const Force* force : force::all)
    if (force->conserves) visit(force->name, r.energy.of[*force]);
  works(Force::Group::internal);
  visit("contact", r.works.contact), visit("tearing", r.works.tearing);
  works(Force::Group::external);
  visit("hand", r.works.hand), visit("edits", r.works.edits);
  visit("unexplained", r.unexplained()), visit("scale", r.scale);
}

}  // namespace

std::vector<SeriesColumn> ledger_columns() {
  std::vector<SeriesColumn> columns;
  for_each_entry({}, [&](std::string_view name, double) { columns.push_back({std::string(name), "J"}); });
  columns.push_back({"share", ""});
  return columns;
}

std::vector<double> ledger_values(const LedgerReading& r) {
  std::vector<double> values;
  for_each_entry(r, [&](std::string_view, double value) { values.push_back(value); });
  values.push_back(r.share());
  return values;
}

}  // namespace tyglab
