// Outputs: written beside their name, in place when whole, the older file untouched until then.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <thread>

#include "core/io/output_file.h"
#include "core/output/series_csv.h"
#include "core/output/state_csv.h"
#include "tests/support/files.h"
#include "tests/support/skip.h"

namespace tyglab::output_file_test {

namespace fs = std::filesystem;

mode_t mode_of(const fs::path& file) {
  struct stat status = {};
  REQUIRE(::stat(file.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

int files_in(const fs::path& folder) {
  return int(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string refusal(const fs::path& file) {
  try {
    OutputFile out(file);
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

/// While one lives, no file of this process grows beyond that many bytes.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_) == 0);
    const rlimit limit{bytes, old_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_ = {};
  void (*handler_)(int) = nullptr;
};

const std::array<SeriesColumn, 1> one_column{SeriesColumn{"y", "m"}};

TEST_CASE("the older file stands until the new one is whole") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "out.csv";
  test::write_file(file, "older");
  {
    OutputFile out(file);
    out.write("new ");
    CHECK(test::read_file(file) == "older");
    CHECK(out.path() == folder / "out.csv.incomplete");
    out.write("content");
    out.end();
    CHECK(out.path() == file);
    CHECK(test::read_file(file) == "new content");
  }
  CHECK(test::read_file(file) == "new content");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("what is not ended stays beside the older file as far as it is of use, and not at all where nothing is") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "out.csv", beside = folder / "out.csv.incomplete";
  test::write_file(file, "older");
  {
    OutputFile out(file);
    out.write("a part of something");
  }
  CHECK(files_in(folder.path()) == 1);
  {
    OutputFile out(file);
    out.write("row\n");
    out.keep();
    out.write("half a r");
  }
  CHECK(test::read_file(beside) == "row\n");
  CHECK(test::read_file(file) == "older");
  // The next run makes room for its own.
  write_atomically(file, "newer");
  CHECK(test::read_file(file) == "newer");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("how far it came decides whether an output takes its name") {
  for (const bool older : {false, true}) {
    CAPTURE(older);
    for (const Reach reach : {Reach::whole, Reach::stopped, Reach::cut_short}) {
      CAPTURE(int(reach));
      const test::TemporaryFolder folder;
      const fs::path file = folder / "out.csv";
      if (older) test::write_file(file, "older");
      const fs::path where = write_output(file, "new", reach);
      const bool takes_name = reach == Reach::whole || (reach == Reach::stopped && !older);
      CHECK(where == (takes_name ? file : folder / "out.csv.incomplete"));
      CHECK(test::read_file(where) == "new");
      if (older && !takes_name) CHECK(test::read_file(file) == "older");
      CHECK(files_in(folder.path()) == (older && !takes_name ? 2 : 1));
    }
  }
}

TEST_CASE("a replaced file keeps its permissions and its owner, a new one gets those of the process") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "out.csv";
  for (const mode_t mode : {0600, 0640, 0644, 0664, 0755, 0200}) {
    CAPTURE(mode);
    test::write_file(file, "older");
    REQUIRE(::chmod(file.c_str(), mode) == 0);
    {
      OutputFile out(file);
      CHECK(mode_of(out.path()) == mode);  // the new one is as private as the older one
      out.write("new");
      out.end();
    }
    CHECK(mode_of(file) == mode);
    fs::remove(file);
  }
  for (const mode_t mask : {022, 077, 002}) {
    CAPTURE(mask);
    const mode_t before = ::umask(mask);
    write_atomically(file, "new");
    ::umask(before);
    CHECK(mode_of(file) == (0666 & ~mask));
    fs::remove(file);
  }
  if (::geteuid() != 0) return test::skip("only an administrator can give a file away", test::Missing::of_machine);
  test::write_file(file, "older");
  REQUIRE(::chown(file.c_str(), 12345, 54321) == 0);
  write_atomically(file, "new");
  struct stat status = {};
  REQUIRE(::stat(file.c_str(), &status) == 0);
  CHECK(status.st_uid == 12345);
  CHECK(status.st_gid == 54321);
}

TEST_CASE("a read-only file is not replaced, also by an administrator, and also if it becomes so meanwhile") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "out.csv";
  test::write_file(file, "older");
  REQUIRE(::chmod(file.c_str(), 0444) == 0);
  CHECK(refusal(file).find("out.csv: is read-only") != std::string::npos);
  CHECK(refusal(file).find("chmod u+w") != std::string::npos);
  REQUIRE(::chmod(file.c_str(), 0644) == 0);
  {
    OutputFile out(file);
    out.write("new");
    out.keep();
    REQUIRE(::chmod(file.c_str(), 0444) == 0);
    CHECK_THROWS_AS(out.end(), OutputError);
  }
  CHECK(test::read_file(file) == "older");
  CHECK(test::read_file(folder / "out.csv.incomplete") == "new");
}

TEST_CASE("what cannot be written is refused before any work, by its name") {
  const test::TemporaryFolder folder;
  CHECK(refusal(folder.path()).find("is a folder") != std::string::npos);
  CHECK(refusal(folder / "missing" / "a.csv").find("does not exist") != std::string::npos);
  CHECK_FALSE(refusal("").empty());
  CHECK_FALSE(refusal("/dev/full/a.csv").empty());
  fs::create_symlink("circle.csv", folder / "circle.csv");
  CHECK(refusal(folder / "circle.csv").find("leads back to itself") != std::string::npos);
  REQUIRE(::mkfifo((folder / "pipe.csv.incomplete").c_str(), 0600) == 0);
  CHECK(refusal(folder / "pipe.csv").find("blocks a new file") != std::string::npos);
  fs::create_directory(folder / "taken.csv.incomplete");
  CHECK(refusal(folder / "taken.csv").find("taken.csv.incomplete") != std::string::npos);
  fs::create_symlink("/etc/passwd", folder / "trap.csv.incomplete");
  CHECK(refusal(folder / "trap.csv").find("trap.csv.incomplete: blocks a new file") != std::string::npos);
}

TEST_CASE("a link stays a link, and the other names of a replaced file keep the older content") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "data");
  test::write_file(folder / "data/real.csv", "older");
  REQUIRE(::chmod((folder / "data/real.csv").c_str(), 0600) == 0);
  fs::create_symlink("data/real.csv", folder / "link.csv");
  fs::create_hard_link(folder / "data/real.csv", folder / "second.csv");
  {
    OutputFile out(folder / "link.csv");
    CHECK(out.path() == folder / "data/real.csv.incomplete");  // on the disk on which it takes its place
    out.write("new");
    out.end();
  }
  CHECK(fs::is_symlink(folder / "link.csv"));
  CHECK(test::read_file(folder / "data/real.csv") == "new");
  CHECK(mode_of(folder / "data/real.csv") == 0600);
  CHECK(test::read_file(folder / "second.csv") == "older");
}

TEST_CASE("pipes and devices take the bytes as they come") {
  const test::TemporaryFolder folder;
  const fs::path fifo = folder / "fifo";
  REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
  std::string read;
  std::thread reader([&] { read = test::read_file(fifo); });
  {
    SeriesCsv series(fifo, one_column, "0");
    series.add(0, std::array{1.0});
    series.end(Reach::cut_short);
  }
  reader.join();
  CHECK(read == "# tyglab series, t in s, preset hash 0\nt,y [m]\n0,1\n");
  CHECK(files_in(folder.path()) == 1);
  CHECK(fs::is_fifo(fifo));
  write_atomically("/dev/null", "text");
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS(write_atomically("/dev/full", "text"), OutputError);
  // What a shell has opened under a number is no name that a new file could take.
  const int opened = ::open((folder / "opened").c_str(), O_RDWR | O_CREAT, 0600);
  REQUIRE(opened >= 0);
  write_atomically("/dev/fd/" + std::to_string(opened), "through");
  std::array<char, 100> text{};
  CHECK(::pread(opened, text.data(), text.size(), 0) == 7);
  CHECK(std::string(text.data()) == "through");
  ::close(opened);
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("a point cache is refused by a pipe") {
  const test::TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  std::thread reader([&] { test::read_file(folder / "fifo"); });
  CHECK_THROWS_AS(PointCache(folder / "fifo", 1), OutputError);
  reader.join();
}

TEST_CASE("a full disk keeps whole rows and samples beside the older file, and says where") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "s.csv", "older");
  test::write_file(folder / "c.pc2", "older");
  test::write_file(folder / "w.csv", "older");
  const auto fills = [](const auto& work) -> std::string {
    const FileSizeLimit limit(1000);
    try {
      work();
    } catch (const OutputError& error) {
      return error.what();
    }
    return {};
  };
  const std::string of_series = fills([&] {
    SeriesCsv series(folder / "s.csv", one_column, "0");
    for (int n = 0; n < 1000; ++n) series.add(n, std::array{0.5});
  });
  CHECK(of_series.find("s.csv: cannot be written") != std::string::npos);
  CHECK(of_series.find("s.csv.incomplete") != std::string::npos);
  const std::string rows = test::read_file(folder / "s.csv.incomplete");
  CHECK(rows.size() > 900);
  CHECK(rows.ends_with(",0.5\n"));
  CHECK(test::read_file(folder / "s.csv") == "older");

  VectorField<double> x;
  x.x = x.y = x.z = {1, 2, 3};
  const std::string of_cache = fills([&] {
    PointCache cache(folder / "c.pc2", 3);
    while (true) cache.add(x);
  });
  CHECK(of_cache.find("c.pc2.incomplete") != std::string::npos);
  const std::string cache = test::read_file(folder / "c.pc2.incomplete");
  CHECK(cache.size() == 32 + 26 * 36);
  CHECK(cache[28] == 26);
  CHECK(test::read_file(folder / "c.pc2") == "older");

  CHECK_FALSE(fills([&] { write_atomically(folder / "w.csv", std::string(2000, 'a')); }).empty());
  CHECK(test::read_file(folder / "w.csv") == "older");
  CHECK_FALSE(fs::exists(folder / "w.csv.incomplete"));
}

TEST_CASE("two writers of one output: the second is refused, or comes after the first") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "out.csv";
  {
    OutputFile first(file);
    first.write("first");
    CHECK(refusal(file).find("another program is writing it") != std::string::npos);
    first.end();
  }
  CHECK(test::read_file(file) == "first");
  // Short writes wait for each other: each is whole.
  std::vector<std::thread> writers;
  for (const char letter : {'a', 'b', 'c', 'd'})
    writers.emplace_back([&, letter] {
      for (int n = 0; n < 25; ++n) write_atomically(file, std::string(20000, letter));
    });
  for (std::thread& writer : writers) writer.join();
  const std::string text = test::read_file(file);
  CHECK(text == std::string(20000, text[0]));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("SIGKILL at any moment leaves the older file or the new one") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "out.csv";
  const std::string older(3000, 'o'), newer(200000, 'n');
  int replaced = 0;
  for (int n = 0; n < 40; ++n) {
    test::write_file(file, older);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      OutputFile out(file);
      for (std::size_t at = 0; at < newer.size(); at += 1000) out.write(std::string_view(newer).substr(at, 1000));
      out.end();
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(37 * n));
    ::kill(child, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    const std::string text = test::read_file(file);
    CHECK((text == older || text == newer));
    replaced += text == newer;
  }
  CAPTURE(replaced);
  write_atomically(file, "afterwards");
  CHECK(files_in(folder.path()) == 1);
}

}  // namespace tyglab::output_file_test
