// Counts what the steps of a solver take from the heap by replacing operator new in this program.
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

#include "small_scene.hpp"

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  void* p = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (!p) throw std::bad_alloc();
  return p;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size > 0 ? size : 1, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size > 0 ? size : 1, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace cobasis;

namespace {

long allocations_in_steps(const Setup& setup, CellType type, int n, int warm_up, int steps) {
  SmallScene scene = small_scene(setup, small_mesh(type, n));
  for (int i = 0; i < warm_up; ++i) scene.solver->advance(1);
  allocations = 0;
  counting = true;
  for (int i = 0; i < steps; ++i) scene.solver->advance(1);
  counting = false;
  return allocations;
}

}  // namespace

TEST_CASE("the counter sees an allocation") {
  allocations = 0;
  counting = true;
  delete new int(1);
  AlignedVector<double>(3, 1.0);
  counting = false;
  CHECK(allocations == 2);
}

TEST_CASE("a step of a solid alone allocates nothing") {
  CHECK(allocations_in_steps(busy_setup({"copper"}, true), CellType::quadrilateral, 12, 2, 20) == 0);
  CHECK(allocations_in_steps(busy_setup({"copper"}, false), CellType::hexahedron, 5, 2, 10) == 0);
}

TEST_CASE("a step with an interface that moves through the mesh allocates nothing") {
  for (const std::vector<std::string>& phases :
       {std::vector<std::string>{"void", "copper"}, {"water", "copper", "aluminium"}}) {
    Setup setup = busy_setup(phases, true);
    CAPTURE(phases);
    CHECK(allocations_in_steps(setup, CellType::quadrilateral, 16, 5, 40) == 0);
  }
}
