#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "mesh/child_process.hpp"
#include "mesh_files.hpp"
#include "mixed_mesh.hpp"

using namespace cobasis;
using Catch::Contains;

TEST_CASE("a .geo that runs commands is refused by line, and runs them when trusted") {
  const Folder folder;
  const std::string trace = folder.path("trace");
  MeshRequest request;
  request.file = folder.write("a.geo", strip_geo(2, 2) + "SystemCall \"touch " + trace + "\";\n");
  CHECK_THAT(error_of(request), Contains("a.geo:10: 'SystemCall'") && Contains("--trust-geo"));
  CHECK_FALSE(std::filesystem::exists(trace));
  request.trust_geo = true;
  CHECK(error_of(request).empty());
  CHECK(std::filesystem::exists(trace));
}

TEST_CASE("commands that touch files are refused wherever they stand") {
  const std::string geo = strip_geo(2, 2);
  for (const std::string line :
       {"Merge \"b.geo\";", "Include 'b.geo';", "Save \"b.msh\";", "Print \"b.png\";", "System \"ls\";",
        "NonBlockingSystemCall \"ls\";", "OnelabRun(\"a\");", "CreateDir \"d\";", "Plugin(Distance).Run;",
        "General.ErrorFileName = \"x\";", "Printf(\"hello\") > \"b.txt\";", "Printf(\"a\") >> \"b.txt\";",
        "Field[1] = ExternalProcess;", "x = \"EndIf\nSystemCall 'ls'; /* \"; // */", "x = \"Merge it\";"}) {
    INFO(line);
    CHECK_THAT(error_of_text("a.geo", geo + line + "\n"), Contains("a.geo:10: ") && Contains("--trust-geo"));
  }
}

TEST_CASE("comments and harmless commands are not refused") {
  const std::string geo = strip_geo(2, 2);
  for (const std::string line : {"// SystemCall \"ls\";", "/* Merge\n \"b.geo\"; */", "Printf(\"%g > %g\", 1, 2);",
                                 "If (2 > 1) Printf(\"yes\"); EndIf"}) {
    INFO(line);
    CHECK(error_of_text("a.geo", geo + line + "\n") == "");
  }
}

TEST_CASE("a script that ends Gmsh gives an error") {
  CHECK_THAT(error_of_text("a.geo", strip_geo(2, 2) + "Exit;\n"), Contains("ended early"));
}

TEST_CASE("a crash, an early exit and too much memory in a child are reported") {
  using Bytes = std::vector<char>;
  CHECK_THAT(run_in_child([] { return raise(SIGSEGV), Bytes(); }, {}).error, Contains("signal 11"));
  CHECK_THAT(run_in_child([]() -> Bytes { _exit(0); }, {}).error, Contains("ended early"));
  CHECK_THAT(run_in_child([]() -> Bytes { throw InputError("reason"); }, {}).error, Contains("reason"));
  const std::size_t GB = std::size_t{1} << 30;
  const ChildResult big = run_in_child(
      [&] {
        Bytes bytes;
        bytes.reserve(8 * GB);  // clang 14 crashes on 8 GB of a given letter
        return bytes;
      },
      {GB, false});
  CHECK_THAT(big.error, Contains("memory") || Contains("ended early"));  // the latter under AddressSanitizer
  const ChildResult fine = run_in_child([] { return Bytes{'a', 'b'}; }, {std::size_t{1} << 30, true});
  CHECK(fine.error == "");
  CHECK(fine.bytes == Bytes{'a', 'b'});
}

TEST_CASE("a confined child can read but neither write nor start programs") {
  const Folder folder;
  const std::string old = folder.write("old", "text"), fresh = folder.path("fresh");
  const ChildResult result = run_in_child(
      [&] {
        const int status = std::system(("touch " + fresh).c_str());
        return std::vector<char>{open(old.c_str(), O_RDONLY) >= 0,
                                 open(old.c_str(), O_WRONLY) >= 0,
                                 open(fresh.c_str(), O_CREAT | O_RDWR, 0600) >= 0,
                                 std::remove(old.c_str()) == 0,
                                 std::rename(old.c_str(), fresh.c_str()) == 0,
                                 status == 0};
      },
      {0, true});
  CHECK(result.error == "");
  CHECK(result.bytes == std::vector<char>{1, 0, 0, 0, 0, 0});
  CHECK(std::filesystem::exists(old));
  CHECK_FALSE(std::filesystem::exists(fresh));
}

TEST_CASE("a script beside the mesh, which Gmsh would run, is not read unless trusted") {
  const Folder folder;
  const std::string trace = folder.path("trace");
  const std::string evil = "Mesh.ElementOrder = 2; SystemCall \"touch " + trace + "\";\n";
  MeshRequest request;
  request.file = folder.write("a.geo", strip_geo(2, 2));
  folder.write("a.geo.opt", evil);
  folder.write("b.msh.opt", evil);
  const Mesh mesh = read_mesh(request, test_mpi());
  REQUIRE(mesh.notices.size() == 1);
  CHECK_THAT(mesh.notices[0], Contains("a.geo.opt is not read") && Contains("--trust-geo"));
  CHECK(read(folder.write("b.msh", mixed_mesh(0).text())).notices.empty());
  CHECK_FALSE(std::filesystem::exists(trace));
  request.trust_geo = true;
  read_mesh(request, test_mpi());
  CHECK(std::filesystem::exists(trace));
}

TEST_CASE("a script of a hundred thousand words is read in little time") {
  std::string script = strip_geo(2, 2);
  for (int i = 0; i < 100000; ++i) script += "Printf ";
  CHECK_THAT(error_of_text("a.geo", script + "SystemCall \"ls\";"), Contains("'SystemCall'"));
}

TEST_CASE("a script that asks for a trillion cells is refused, not the machine brought down") {
  MeshRequest request;
  const Folder folder;
  request.file = folder.write("a.geo", strip_geo(2, 2));
  request.parameters = {{"nx", 2e9}, {"ny", 500}};
  // As under `ulimit -v`: what this process may have, the child may not exceed; all of the memory takes minutes to
  // fill.
  rlimit own{};
  REQUIRE(getrlimit(RLIMIT_AS, &own) == 0);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlimit tight{pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (std::size_t{1} << 30), own.rlim_max};
  REQUIRE(setrlimit(RLIMIT_AS, &tight) == 0);
  const std::string error = error_of(request);
  REQUIRE(setrlimit(RLIMIT_AS, &own) == 0);
  CHECK_THAT(error, Contains("a.geo: Gmsh could not mesh it"));
}
