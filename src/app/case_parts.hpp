// The parts of a case, each read from its table into the setup.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/case_table.hpp"
#include "solver/setup.hpp"

namespace cobasis {

struct CaseReading {
  Setup setup;
  Mistakes mistakes;
  std::vector<bool> phase_is_right;  ///< of each phase: read without a mistake, so that its states can be checked

  /// Index of the phase; a mistake if there is none of this name.
  std::optional<int> phase(const std::string& name, const Place& where);
};

void read_phases(const CaseTable& top, CaseReading& reading);
void read_contacts(const CaseTable& top, CaseReading& reading);
void read_relaxations(const CaseTable& top, CaseReading& reading);
void read_regions(const CaseTable& top, CaseReading& reading);
void read_boundaries(const CaseTable& top, CaseReading& reading);
/// [output], and what is sampled: [[line]], [[probe]], [[integral]].
void read_output(const CaseTable& top, CaseReading& reading);

/// What fills a region or enters through an inflow: the keys "filling" of the table.
std::optional<Filling> read_filling(CaseTable& table, CaseReading& reading);

/// Adds the keys of the list to those at hand.
std::vector<KeyInfo> together(std::vector<KeyInfo> keys, const KeyTable& more);
/// And those that go with a word, in the tables "title = WORD": a shape's, a boundary type's; of an unknown word any of
/// its alternatives', since which were meant is not known.
std::vector<KeyInfo> keys_with(std::vector<KeyInfo> keys, std::string_view title, const std::string* word,
                               const std::vector<std::string>& words);
/// The text at a key of a table that has not been checked; null if there is none.
const std::string* text_at(const TomlTable& table, std::string_view key);
/// What a word_or_table holds as a table: a word alone is the table that has it as type.
TomlTable table_of(const TomlEntry& word_or_table);
/// The key "type" of such a table.
KeyInfo type_key(const KeyInfo& word_or_table);

/// Mistakes of a setup in this geometry, see check_for_geometry.
std::vector<std::string> mistakes_in_geometry(const Setup& setup, Geometry geometry);

}  // namespace cobasis
