// `tyglab bench contact`: the cost of contact of the cloth with itself.
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/interrupt.h"
#include "core/analysis/machine.h"
#include "core/io/output_file.h"
#include "tests/bench/contact.h"
#include "tests/bench/throughput.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

struct ContactOptions : BenchOptions {
  int side = 0;  ///< 0: three sizes
};

Json row_json(const ContactRow& row) {
  return {{"rows", row.side},
          {"columns", row.side},
          {"precision", "float"},
          {"threads", 1},
          {"rounds", row.rounds},
          {"ns_off", row.ns_off},
          {"ns_apart", row.ns_apart},
          {"ns_pile", row.ns_pile},
          {"ns_hash_grid", row.ns_hash_grid},
          {"pairs_per_particle", row.pairs},
          {"bytes_apart_per_particle", row.bytes_apart},
          {"bytes_pile_per_particle", row.bytes_pile}};
}

void print_row(std::ostream& out, const ContactRow& row) {
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), "%4d x %-4d  %7.2f  %7.2f  %5.2f  %7.0f  %9.0f  %6.2f  %6.0f  %6.0f\n",
                row.side, row.side, row.ns_off, row.ns_apart, row.ns_apart / row.ns_off, row.ns_pile, row.ns_hash_grid,
                row.pairs, row.bytes_apart, row.bytes_pile);
  out << line.data() << std::flush;
  flush_standard_output();
}

int contact(const ContactOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  out << machine_line()
      << "\nContact of the cloth with itself, verlet in float, one thread. ns per particle and step: of a cloth that\n"
         "begins to swing, without contact (off) and with it, nothing being near (apart); of a sheet that crumples\n"
         "(pile); and of a search for its near pairs with a hash grid, alone. Then near pairs there, and bytes of\n"
         "contact, per particle.\n\n"
         "cloth            off    apart  ratio     pile  hash grid   pairs   apart    pile\n"
      << std::flush;
  Json json = Json::array();
  InterruptGuard guard;
  wake_processor();
  const std::vector<int> sides = options.side > 0 ? std::vector{options.side}
                                 : options.quick  ? std::vector{16, 32}
                                                  : std::vector{32, 64, 128};
  for (const int side : sides) {
    if (InterruptGuard::interrupted()) break;
    const ContactRow row = measure_contact(side, options.quick ? 3 : 7);
    print_row(out, row);
    json.push_back(row_json(row));
  }
  if (!options.json.empty()) write_output(options.json, json_text(bench_json("contact", json)), bench_reach());
  return bench_exit(options.outputs());
}

}  // namespace

void add_bench_contact(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "contact", "Cost of contact of the cloth with itself: off, with nothing near, and in a crumpled sheet");
  const auto options = std::make_shared<ContactOptions>();
  CLI::Option* quick = add_quick(*command, *options, "Smaller cloths and fewer rounds");
  command->add_option("--side", options->side, "Particles per side of the cloth (default: 32, 64 and 128)")
      ->type_name("N")
      ->transform(whole_number_between(4, 1024))
      ->excludes(quick);
  add_json(*command, *options);
  command->footer("Example: tyglab bench contact --json contact.json");
  command->callback([&action, options] { action = [options] { return contact(*options); }; });
}

}  // namespace tyglab
