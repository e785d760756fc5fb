// The program as its user meets it: a child process with its exit status, what it said, and the files it left.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cobasis::test {

/// A folder that goes with its owner.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path path(const std::string& name) const { return path_ / name; }
  std::string write(const std::string& name, const std::string& text) const;
  /// Names of what lies in it, sorted.
  std::vector<std::string> contents() const;

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int status = 0;  ///< exit status; 128 + signal
  std::string out, err;
};

/// A line for bash, run in the folder with ranks allowed beyond the number of cores and for root.
Outcome shell(const std::string& line, const Folder& folder);

/// The program's path followed by these arguments, as a line for bash.
std::string program_with(const std::string& arguments);

/// A word for bash, whatever it contains.
std::string quoted(const std::string& word);

/// The whole of a file. Throws if there is none.
std::string contents_of(const std::filesystem::path& file);
std::vector<std::string> lines_of(const std::string& text);
/// Fields of a line of CSV without quotation.
std::vector<std::string> fields_of(const std::string& line);

/// The text with its first `found` replaced. Throws if there is none.
std::string with(std::string text, const std::string& found, const std::string& replacement);

/// One of the project's cases.
std::string case_file(const std::string& name);

}  // namespace cobasis::test
