// [phase.NAME], [contact] and [relaxation].
#include <fmt/format.h>

#include <algorithm>

#include "app/case_parts.hpp"
#include "math/suggestion.hpp"
#include "physics/material_library.hpp"
#include "solver/interfaces.hpp"

namespace cobasis {
namespace {

std::string type_title(std::string_view name) { return fmt::format("eos type = {}", name); }

std::string name_of(const Eos& eos) {
  return std::visit([](const auto& e) { return std::string(e.name); }, eos);
}

template <class Owner>
void read_fields(const CaseTable& table, Owner& owner) {
  for (const auto& field : Owner::fields())
    if (const auto value = table.number(field.key)) owner.*field.member = *value;
}

void make_optional(std::vector<KeyInfo>& keys) {
  for (KeyInfo& key : keys) key.required = false;
}

/// The equation of state of this type, if the table or else the material asks for it.
template <class Equation>
void read_if_asked(const TomlEntry& entry, const std::string& type, const Material* material, CaseReading& reading,
                   std::optional<Eos>& eos) {
  if (type != Equation::name) return;
  const auto* base = material ? std::get_if<Equation>(&material->eos) : nullptr;
  auto keys = together(keys_of("eos").keys, keys_of(type_title(type)));
  if (base) make_optional(keys);
  const CaseTable table(std::get<TomlTable>(entry.value.data), entry.where, keys, type_title(type), reading.mistakes);
  Equation equation = base ? *base : Equation{};
  read_fields(table, equation);
  eos = equation;
}

template <class... Equation>
std::optional<Eos> read_eos(const TomlEntry& entry, const Material* material, CaseReading& reading,
                            const std::variant<Equation...>*) {
  const TomlEntry* given = find_entry(std::get<TomlTable>(entry.value.data), "type");
  const auto* text = given ? std::get_if<std::string>(&given->value.data) : nullptr;
  const std::string type = text ? *text : !given && material ? name_of(material->eos) : "";
  std::optional<Eos> eos;
  (read_if_asked<Equation>(entry, type, material, reading, eos), ...);
  if (!eos) {
    std::vector<KeyInfo> any_type;
    ((any_type = together(std::move(any_type), keys_of(type_title(Equation::name)))), ...);
    make_optional(any_type);
    CaseTable(std::get<TomlTable>(entry.value.data), entry.where, together(std::move(any_type), keys_of("eos")), "eos",
              reading.mistakes);
  }
  return eos;
}

HyperelasticMaterial read_elastic(const TomlEntry& entry, const Material* material, CaseReading& reading) {
  const KeyTable& list = keys_of("elastic");
  std::vector<KeyInfo> keys = list.keys;
  const bool has_base = material && material->elastic;
  if (has_base) make_optional(keys);
  const CaseTable table(std::get<TomlTable>(entry.value.data), entry.where, keys, list.title, reading.mistakes);
  HyperelasticMaterial elastic = has_base ? *material->elastic : HyperelasticMaterial{};
  read_fields(table, elastic);
  return elastic;
}

void read_void(const CaseTable& table, PhaseSetup& phase, CaseReading& reading) {
  for (const char* key : {"elastic", "density"})
    if (table.has(key))
      reading.mistakes.add(table.where(key), fmt::format("\"{}\" of the void \"{}\", which has no state of its own; "
                                                         "allowed: void = {{ pressure = ... }} alone",
                                                         key, phase.name));
  phase.void_pressure = 0;
  if (const auto pressure = table.table("void", keys_of("void")))
    phase.void_pressure = pressure->number("pressure").value_or(0);
  for (const PhaseSetup& other : reading.setup.phases)
    if (other.is_void())
      reading.mistakes.add(table.where("void"), fmt::format("\"{}\" is a second void beside \"{}\"; allowed: one void",
                                                            phase.name, other.name));
}

void read_material(const CaseTable& table, PhaseSetup& phase, CaseReading& reading) {
  if (!table.has("material") && !table.has("eos"))
    reading.mistakes.add(table.where(), fmt::format("phase \"{}\" has neither material nor eos nor void; allowed: "
                                                    "material and / or eos, or void",
                                                    phase.name));
  const auto name = table.text("material");
  const Material* material = name ? find_material(*name) : nullptr;
  if (material) {
    phase.eos = material->eos;
    phase.elastic = material->elastic;
    phase.density = material->rho0;
  }
  if (const TomlEntry* entry = table.table("eos"))
    phase.eos = read_eos(*entry, material, reading, &phase.eos).value_or(phase.eos);
  if (const TomlEntry* entry = table.table("elastic")) phase.elastic = read_elastic(*entry, material, reading);
  if (const auto density = table.number("density")) phase.density = density;
  if (phase.is_solid()) {
    phase.density = phase.elastic->rho0;
    if (table.has("density"))
      reading.mistakes.add(table.where("density"),
                           fmt::format("density of the solid \"{}\"; allowed: elastic = {{ rho0 = ... }} for the "
                                       "undeformed solid, density in a region",
                                       phase.name));
  }
}

bool is_phase_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

/// All ways to split the key at a - into the names of two different phases that are no void.
std::vector<std::pair<int, int>> pairs_of(const std::string& key, const std::vector<PhaseSetup>& phases) {
  std::vector<std::pair<int, int>> pairs;
  for (int l = 0; l < static_cast<int>(phases.size()); ++l)
    for (int m = 0; m < static_cast<int>(phases.size()); ++m)
      if (l != m && !phases[l].is_void() && !phases[m].is_void() && key == phases[l].name + "-" + phases[m].name)
        pairs.emplace_back(std::min(l, m), std::max(l, m));
  return pairs;
}

std::vector<std::string> names_of_pairs(const std::vector<PhaseSetup>& phases) {
  std::vector<std::string> keys;
  for (std::size_t l = 0; l < phases.size(); ++l)
    for (std::size_t m = l + 1; m < phases.size(); ++m)
      if (!phases[l].is_void() && !phases[m].is_void()) keys.push_back(phases[l].name + "-" + phases[m].name);
  return keys;
}

Contact read_contact(const KeyInfo& info, const TomlEntry& entry, CaseReading& reading) {
  if (!check_value(info, entry.key, entry.value, reading.mistakes)) return {};
  const TomlTable given = table_of(entry);
  const auto keys = keys_with({type_key(info)}, "[contact] type", text_at(given, "type"), info.words);
  const CaseTable table(given, entry.where, keys, fmt::format("contact \"{}\"", entry.key), reading.mistakes);
  const std::string type = table.text("type").value_or("sliding");
  if (type == "adherence") return Contact::adherence;
  if (type == "friction") return {Contact::friction, table.number("coefficient").value_or(0)};
  return Contact::sliding;
}

}  // namespace

std::vector<KeyInfo> together(std::vector<KeyInfo> keys, const KeyTable& more) {
  for (const KeyInfo& key : more.keys)
    if (std::ranges::find(keys, key.key, &KeyInfo::key) == keys.end()) keys.push_back(key);
  return keys;
}

const std::string* text_at(const TomlTable& table, std::string_view key) {
  const TomlEntry* entry = find_entry(table, key);
  return entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
}

std::vector<KeyInfo> keys_with(std::vector<KeyInfo> keys, std::string_view title, const std::string* word,
                               const std::vector<std::string>& words) {
  if (word && std::ranges::find(words, *word) != words.end())
    return together(std::move(keys), keys_of(fmt::format("{} = {}", title, *word)));
  for (const std::string& any : words) {
    KeyTable table = keys_of(fmt::format("{} = {}", title, any));
    for (KeyInfo& key : table.keys) key.required = false;
    keys = together(std::move(keys), table);
  }
  return keys;
}

TomlTable table_of(const TomlEntry& word_or_table) {
  const auto* keys = std::get_if<TomlTable>(&word_or_table.value.data);
  return keys ? *keys : TomlTable{{"type", word_or_table.where, word_or_table.value}};
}

KeyInfo type_key(const KeyInfo& word_or_table) {
  return {
      .key = "type", .kind = KeyKind::word, .words = word_or_table.words, .required = true, .meaning = "what it is"};
}

std::optional<int> CaseReading::phase(const std::string& name, const Place& where) {
  const auto found = std::ranges::find(setup.phases, name, &PhaseSetup::name);
  if (found != setup.phases.end()) return static_cast<int>(found - setup.phases.begin());
  if (setup.phases.empty()) return std::nullopt;  // that no phase could be read is a mistake already
  std::vector<std::string> names;
  for (const PhaseSetup& phase : setup.phases) names.push_back(phase.name);
  mistakes.add(where, fmt::format("unknown phase \"{}\"; {}", name, allowed_names(name, names)));
  return std::nullopt;
}

void read_phases(const CaseTable& top, CaseReading& reading) {
  const TomlEntry* phases = top.table("phase");
  if (!phases) return;
  constexpr std::size_t most = Interfaces::most_phases;
  if (const std::size_t n = std::get<TomlTable>(phases->value.data).size(); n > most) {
    reading.mistakes.add(phases->where, fmt::format("{} phases; allowed: at most {}", n, most));
    return;
  }
  for (const TomlEntry& entry : std::get<TomlTable>(phases->value.data)) {
    const std::size_t before = reading.mistakes.count();
    PhaseSetup phase;
    phase.name = entry.key;
    if (!is_phase_name(entry.key))
      reading.mistakes.add(entry.where,
                           fmt::format("phase name \"{}\"; allowed: letters, digits, _ and -, at most 100", entry.key));
    if (const auto* keys = std::get_if<TomlTable>(&entry.value.data)) {
      CaseTable table(*keys, entry.where, keys_of("[phase.NAME]"), reading.mistakes);
      table.at_most_one({"void", "material"});
      table.at_most_one({"void", "eos"});
      if (table.has("void"))
        read_void(table, phase, reading);
      else
        read_material(table, phase, reading);
    } else {
      reading.mistakes.add(entry.where, fmt::format("phase.{} = {}; allowed: a table with the keys of a phase",
                                                    entry.key, description(entry.value)));
    }
    reading.setup.phases.push_back(std::move(phase));
    reading.phase_is_right.push_back(reading.mistakes.count() == before);
  }
  if (std::ranges::all_of(reading.setup.phases, &PhaseSetup::is_void))
    reading.mistakes.add(phases->where, "no phase but a void; allowed: at least one phase with a material or eos");
  const auto a_void = std::ranges::find_if(reading.setup.phases, &PhaseSetup::is_void);
  if (reading.setup.alpha_min > 0 && a_void != reading.setup.phases.end())
    reading.mistakes.add(top.where("alpha_min"), fmt::format("alpha_min = {} together with the void \"{}\"; allowed: 0 "
                                                             "with a void",
                                                             reading.setup.alpha_min, a_void->name));
  const auto n_phases = static_cast<double>(reading.setup.phases.size());
  if (n_phases * reading.setup.alpha_min >= 1)
    reading.mistakes.add(top.where("alpha_min"), fmt::format("alpha_min = {} with {} phases; allowed: less than {:.3g}",
                                                             reading.setup.alpha_min, n_phases, 1 / n_phases));
}

void read_contacts(const CaseTable& top, CaseReading& reading) {
  const TomlEntry* contacts = top.table("contact");
  if (!contacts) return;
  Setup& setup = reading.setup;
  const KeyInfo& info = keys_of("[contact]").keys.front();
  std::vector<std::string> allowed = names_of_pairs(setup.phases);
  allowed.insert(allowed.begin(), info.key);
  for (const TomlEntry& entry : std::get<TomlTable>(contacts->value.data)) {
    const Contact contact = read_contact(info, entry, reading);
    const auto pairs = pairs_of(entry.key, setup.phases);
    if (entry.key == info.key)
      setup.default_contact = contact;
    else if (pairs.empty())
      reading.mistakes.add(entry.where, fmt::format("contact \"{}\" is not between two phases with a state; {}",
                                                    entry.key, allowed_names(entry.key, allowed)));
    else if (pairs.size() > 1)
      reading.mistakes.add(entry.where, fmt::format("contact \"{}\" names more than one pair of phases; allowed: phase "
                                                    "names that tell the pairs apart",
                                                    entry.key));
    else if (setup.contacts.contains(pairs[0]) && !entry.where.from_command_line())
      reading.mistakes.add(
          entry.where, fmt::format("contact \"{}\" is given twice; allowed: each pair once, either order", entry.key));
    else if (const auto [l, m] = pairs[0];
             contact.kind == Contact::friction && !(setup.phases[l].is_solid() && setup.phases[m].is_solid()))
      reading.mistakes.add(entry.where,
                           fmt::format("friction of \"{}\", of which one is a fluid; allowed: sliding", entry.key));
    else
      setup.contacts[pairs[0]] = contact;
  }
}

void read_relaxations(const CaseTable& top, CaseReading& reading) {
  const TomlEntry* relaxations = top.table("relaxation");
  if (!relaxations) return;
  Setup& setup = reading.setup;
  const KeyInfo& info = keys_of("[relaxation]").keys.front();
  const auto rate = [](const CaseTable& table, std::string_view key) {
    const TomlEntry* given = table.entry(key);
    return !given ? 0 : std::holds_alternative<std::string>(given->value.data) ? infinity : number_of(given->value);
  };
  for (const TomlEntry& entry : std::get<TomlTable>(relaxations->value.data)) {
    if (!check_value(info, entry.key, entry.value, reading.mistakes)) continue;
    const CaseTable table(std::get<TomlTable>(entry.value.data), entry.where, keys_of("relaxation A-B"),
                          reading.mistakes);
    const auto pairs = pairs_of(entry.key, setup.phases);
    if (std::get<TomlTable>(entry.value.data).empty())
      reading.mistakes.add(entry.where,
                           fmt::format("relaxation \"{}\" of nothing; allowed: velocity and / or pressure", entry.key));
    else if (pairs.empty())
      reading.mistakes.add(entry.where, fmt::format("relaxation \"{}\" is not between two phases with a state; {}",
                                                    entry.key, allowed_names(entry.key, names_of_pairs(setup.phases))));
    else if (pairs.size() > 1)
      reading.mistakes.add(entry.where, fmt::format("relaxation \"{}\" names more than one pair of phases; allowed: "
                                                    "phase names that tell the pairs apart",
                                                    entry.key));
    else if (setup.relaxations.contains(pairs[0]) && !entry.where.from_command_line())
      reading.mistakes.add(entry.where, fmt::format("relaxation \"{}\" is given twice; allowed: each pair once, either "
                                                    "order",
                                                    entry.key));
    else
      setup.relaxations[pairs[0]] = {rate(table, "velocity"), rate(table, "pressure")};
  }
}

}  // namespace cobasis
