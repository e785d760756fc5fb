// Mesh and case in, fields for ParaView out. Exit status: 0 done; 2 the input is wrong; 3 the run turned unphysical;
// 4 the system failed.
#include <csignal>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "app/new_case.hpp"
#include "app/simulation.hpp"
#include "app/study.hpp"
#include "math/errors.hpp"
#include "mesh/mesh_info.hpp"
#include "mesh/mpi.hpp"
#include "solver/solver.hpp"

namespace {

void execute(const cobasis::CommandLine& command, const cobasis::Mpi& mpi) {
  using Command = cobasis::CommandLine::Command;
  switch (command.command) {
    case Command::run:
      return cobasis::run_case(command, mpi);
    case Command::check:
      return cobasis::check_case(command, mpi);
    case Command::study:
      return cobasis::study_case(command, mpi);
    case Command::info:
      if (mpi.root()) {
        cobasis::MeshRequest request;
        request.file = command.file;
        request.trust_geo = command.trust_geo;
        std::cout << cobasis::format(cobasis::mesh_info(request));
      }
      return;
    case Command::make:
      if (mpi.root()) std::cout << cobasis::write_new_case(command.file, command.like);
      return;
    case Command::print:
      if (mpi.root()) std::cout << command.text;
      return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error with a message
  const cobasis::Mpi mpi(argc, argv);
  const auto fail = [&](int status, const std::string& what) {
    if (mpi.root()) std::cerr << what << '\n';
    return status;
  };
  try {
    execute(cobasis::read_command_line({argv + 1, argv + argc}), mpi);
    return 0;
  } catch (const cobasis::InputError& error) {
    return fail(2, error.what());
  } catch (const cobasis::Unphysical& error) {
    return fail(3, std::string("cobasis: the run turned unphysical and was stopped: ") + error.what());
  } catch (const cobasis::SystemError& error) {
    return fail(4, error.what());
  } catch (const std::exception& error) {  // out of memory and the like: the other ranks know nothing of it
    std::cerr << "cobasis: rank " << mpi.rank() << ": " << error.what() << '\n';
    if (mpi.size() > 1) mpi.abort(4);
    return 4;
  }
}
