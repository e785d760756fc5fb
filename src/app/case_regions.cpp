// [[region]] and [boundary].
#include <fmt/format.h>

#include <algorithm>

#include "app/case_parts.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

bool is_zero(const Point& x) { return x.x == 0 && x.y == 0 && x.z == 0; }

std::optional<Shape> read_shape(const CaseTable& table, Mistakes& mistakes) {
  const auto point = [&](const char* key) { return table.point(key).value_or(Point{}); };
  const auto shape = table.text("shape");
  if (!shape) return std::nullopt;
  if (*shape == "half_space") {
    const HalfSpace half{point("point"), point("normal")};
    if (table.point("normal") && is_zero(half.normal))
      mistakes.add(table.where("normal"), "normal of length 0; allowed: any other length");
    return half;
  }
  if (*shape == "box") {
    const Box box{point("low"), point("high")};
    if (table.point("low") && table.point("high") &&
        !(box.low.x < box.high.x && box.low.y < box.high.y && box.low.z <= box.high.z))
      mistakes.add(table.where("high"),
                   fmt::format("high = [{}, {}, {}] with low = [{}, {}, {}]; allowed: low < high in every coordinate",
                               box.high.x, box.high.y, box.high.z, box.low.x, box.low.y, box.low.z));
    return box;
  }
  if (*shape == "sphere") return Sphere{point("center"), table.number("radius").value_or(1)};
  if (*shape == "cylinder") {
    const Cylinder cylinder{point("from"), point("to"), table.number("radius").value_or(1)};
    if (table.point("from") && table.point("to") && is_zero(cylinder.to - cylinder.from))
      mistakes.add(table.where("to"), "to = from, a cylinder of length 0; allowed: two different points");
    return cylinder;
  }
  if (*shape == "physical_group") return PhysicalGroup{table.text("name").value_or("")};
  if (*shape == "expression") return Inside{table.expression("inside").value_or(Expression{})};
  return Everywhere{};
}

std::optional<Boundary> read_outlet(const CaseTable& table, CaseReading& reading) {
  const auto pressure = table.number("pressure");
  if (!pressure) return std::nullopt;
  for (const PhaseSetup& phase : reading.setup.phases) {
    if (phase.is_void()) continue;
    const double lowest = std::visit([](const auto& eos) { return eos.lowest_pressure(); }, phase.eos);
    if (!(*pressure > lowest))
      reading.mistakes.add(table.where("pressure"),
                           fmt::format("pressure = {} outside phase \"{}\"; allowed: {} < pressure [Pa]", *pressure,
                                       phase.name, lowest));
  }
  return Outlet{*pressure};
}

std::optional<Boundary> read_boundary(const TomlEntry& entry, CaseReading& reading) {
  const KeyInfo& info = keys_of("[boundary]").keys.front();
  if (!check_value(info, entry.key, entry.value, reading.mistakes)) return std::nullopt;
  const TomlTable given = table_of(entry);
  const std::string* type = text_at(given, "type");
  std::vector<KeyInfo> allowed = keys_with({type_key(info)}, "[boundary] type", type, info.words);
  const bool may_fill = !type || std::ranges::find(info.words, *type) == info.words.end() || *type == "inflow";
  if (may_fill) allowed = together(std::move(allowed), keys_of("filling"));
  CaseTable table(given, entry.where, allowed, fmt::format("boundary \"{}\"", entry.key), reading.mistakes);

  const auto known = table.text("type");
  if (!known) return std::nullopt;
  if (*known == "wall") return Wall{table.vector_field("velocity")};
  if (*known == "no_slip") {
    if (!reading.setup.phases.empty() && std::ranges::none_of(reading.setup.phases, &PhaseSetup::is_solid))
      reading.mistakes.add(entry.where,
                           fmt::format("boundary \"{}\" = \"no_slip\" in a scene of fluids, which have no viscosity; "
                                       "allowed: wall, or a phase with elastic",
                                       entry.key));
    return NoSlip{table.vector_field("velocity").value_or(std::array<Expression, 3>{})};
  }
  if (*known == "outlet") return read_outlet(table, reading);
  if (*known == "symmetry") return Symmetry{};
  if (*known == "axis") return AxisOfSymmetry{};
  if (*known == "transmissive") return Transmissive{};
  if (*known == "periodic") {
    const auto with = table.text("with");
    return with ? std::optional<Boundary>(Periodic{*with}) : std::nullopt;
  }
  auto filling = read_filling(table, reading);
  if (!filling) return std::nullopt;
  for (std::size_t k = 0; k < filling->alpha.size(); ++k)
    if (reading.setup.phases[k].is_void() && filling->alpha[k] > 0)
      reading.mistakes.add(entry.where,
                           fmt::format("inflow of the void \"{}\", which has no state; allowed: other phases",
                                       reading.setup.phases[k].name));
  return Inflow{*std::move(filling)};
}

/// Each group of a periodic pair gets its own entry, whether the case names the pair once or twice.
void complete_periodic_pairs(const TomlTable& table, CaseReading& reading) {
  auto& boundaries = reading.setup.boundaries;
  const auto add = [&](const BoundarySetup& of, const std::string& text) {
    reading.mistakes.add(find_entry(table, of.group)->where, fmt::format("boundary \"{}\": {}", of.group, text));
  };
  const std::size_t n_named = boundaries.size();
  for (std::size_t i = 0; i < n_named; ++i) {
    const auto* periodic = std::get_if<Periodic>(&boundaries[i].boundary);
    if (!periodic) continue;
    const std::string with = periodic->with;
    if (boundaries[i].group == "*" || with == "*" || with == boundaries[i].group || with.empty()) {
      add(boundaries[i], fmt::format("periodic with \"{}\"; allowed: two different physical groups", with));
      continue;
    }
    const auto partner = std::ranges::find(boundaries, with, &BoundarySetup::group);
    const auto* back = partner == boundaries.end() ? nullptr : std::get_if<Periodic>(&partner->boundary);
    if (partner == boundaries.end() && !find_entry(table, with))
      boundaries.push_back({with, Periodic{boundaries[i].group}, boundaries[i].where});
    else if (partner != boundaries.end() && (!back || back->with != boundaries[i].group))
      add(boundaries[i],
          fmt::format("periodic with \"{0}\", but \"{0}\" is {1}; allowed: each the other's partner", with,
                      back ? fmt::format("periodic with \"{}\"", back->with) : "another boundary"));
  }
}

}  // namespace

void read_regions(const CaseTable& top, CaseReading& reading) {
  const TomlEntry* regions = top.entry("region");
  if (!regions) return;
  const auto& tables = std::get<TomlArray>(regions->value.data);
  if (tables.empty()) reading.mistakes.add(regions->where, "no region; allowed: at least one [[region]]");
  const KeyTable& common = keys_of("[[region]]");
  for (const TomlValue& item : tables) {
    const std::size_t before = reading.mistakes.count();
    const auto& given = std::get<TomlTable>(item.data);
    const std::string* word = text_at(given, "shape");
    const auto keys = keys_with(common.keys, "[[region]] shape", word, common.keys.front().words);
    CaseTable table(given, item.where, together(keys, keys_of("filling")),
                    word ? fmt::format("region, shape = \"{}\"", *word) : "region", reading.mistakes);
    const auto shape = read_shape(table, reading.mistakes);
    auto filling = read_filling(table, reading);
    if (shape && filling && reading.mistakes.count() == before)
      reading.setup.regions.push_back({*shape, *std::move(filling), reading.mistakes.where(item.where)});
  }
}

void read_boundaries(const CaseTable& top, CaseReading& reading) {
  const TomlEntry* boundaries = top.table("boundary");
  if (!boundaries) return;
  const auto& table = std::get<TomlTable>(boundaries->value.data);
  for (const TomlEntry& entry : table)
    if (auto boundary = read_boundary(entry, reading))
      reading.setup.boundaries.push_back({entry.key, *std::move(boundary), reading.mistakes.where(entry.where)});
  complete_periodic_pairs(table, reading);
}

}  // namespace cobasis
