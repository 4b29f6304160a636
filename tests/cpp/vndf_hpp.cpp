// vndf.hpp frees what it owns once and leaves empty what was moved from; results say what went wrong and throw
// only if they are asked to; what a callable throws stops a build and does not reach C.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "harness/test.h"
#include "vndf.hpp"

namespace
{

const char table_file[] = VNDF_SOURCE_DIR "/tables/example.vndf";

template <class T>
constexpr bool moves_only = !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T> &&
                            std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T>;
static_assert(moves_only<vndf::distribution> && moves_only<vndf::family> && moves_only<vndf::source>);
static_assert(moves_only<vndf::albedo>);
// A pointer to a temporary owner would dangle.
static_assert(std::is_convertible_v<const vndf::distribution &, const vndf_distribution *>);
static_assert(!std::is_convertible_v<vndf::distribution, const vndf_distribution *>);

// ---- owners ----

void test_distribution()
{
    auto loaded = vndf::load(table_file);
    if (!TEST(loaded && loaded.status() == VNDF_OK && loaded.message()[0] == '\0'))
        return;
    vndf::distribution first = std::move(*loaded), second;
    TEST(first && !*loaded && vndf_distribution_info(*loaded).bytes == 0);
    const vndf_distribution *pointer = first;
    second = std::move(first);
    TEST(second.get() == pointer && !first && !vndf::done(vndf_save, first, "/dev/null"));
    first = *vndf::load(std::string(table_file)); // frees nothing, then something
    first = std::move(second);
    TEST(first.get() == pointer && !second);

    std::vector<unsigned char> bytes(vndf_distribution_info(first).bytes);
    TEST(vndf::done(vndf_save_memory, first, bytes.data(), bytes.size()));
    TEST(vndf::own<vndf::distribution>(vndf_load_memory, bytes.data(), bytes.size()));
    const auto cut = vndf::own<vndf::distribution>(vndf_load_memory, bytes.data(), bytes.size() / 2);
    TEST(!cut && cut.status() == VNDF_ERROR_TABLE && !*cut);
}

void test_builds()
{
    const auto formula = vndf::slope_expression("exp(-k*r)", {{"k", 3.0}});
    vndf_build_options options = {};
    options.max_bytes = 2048;
    options.moments = 3;
    const auto table = vndf::build(*formula, options);
    TEST(table && vndf_distribution_info(*table).moments == 3 && vndf_distribution_info(*table).bytes <= 2048);
    vndf_family_options two = {};
    two.knots = 2;
    two.max_bytes = 2048;
    const auto family = vndf::build_family("student-t", 2.0, 3.0, two);
    TEST(vndf_family_info(*family).count == 2);
    TEST(vndf::own<vndf::albedo>(vndf_albedo_build, vndf_ggx(), 0.0f));
    TEST(!vndf::own<vndf::albedo>(vndf_albedo_build, vndf_ggx(), 1.0f));
    const auto wrong = vndf::ndf_expression("exp(-k*c");
    TEST(!wrong && wrong.status() == VNDF_ERROR_SYNTAX && !*wrong && !vndf::build(*wrong));
}

// A source owns one copy of its callable, of which use_count tells, and frees it.
void test_callable()
{
    const auto count = std::make_shared<int>(0);
    const auto law = [count](double r) { return std::exp(-r * r); };
    const long before = count.use_count();
    {
        auto made = vndf::slope_callback(law, "a law");
        const vndf::source moved = std::move(*made);
        TEST(!*made && vndf_source_p22(moved, 0.5) == std::exp(-0.25) && count.use_count() == before + 1);
        vndf::source other = *vndf::ndf_callback([](double c) { return c; }, "a cosine");
        TEST(vndf_source_p22(other, 0.0) == 1.0);
        other = *vndf::slope_callback(law, "another");
        TEST(count.use_count() == before + 2 && vndf_source_p22(other, 0.0) == 1.0);
    }
    TEST(count.use_count() == before);
}

// ---- errors ----

// The status of the vndf::error that value() throws, or 0.
template <class T> int status_thrown(const vndf::result<T> &failed)
{
    try {
        failed.value();
    } catch (const vndf::error &e) {
        return e.what()[0] ? static_cast<int>(e.status()) : -1;
    }
    return 0;
}

void test_errors()
{
    TEST(status_thrown(vndf::load("/no/such/file")) == VNDF_ERROR_IO);
    TEST(status_thrown(vndf::load(table_file)) == 0);
    TEST(status_thrown(vndf::done(vndf_save, vndf_ggx(), "/dev/null")) == VNDF_ERROR_ARGUMENT);
    vndf_description mirror = {};
    vndf_material material;
    TEST(!vndf::done(vndf_material_resolve, &mirror, &material));
    mirror.surface = vndf_rough(vndf_ggx(), 0.3f, 0.3f);
    TEST(vndf::done(vndf_material_resolve, &mirror, &material));
}

// It stops the build, and is forgotten.
void test_thrown_by_callables()
{
    int calls = 0;
    const auto late = vndf::slope_callback(
        [&](double r) { return ++calls == 100 ? throw std::runtime_error("no such brdf") : std::exp(-r); },
        "late");
    const auto table = vndf::build(*late);
    TEST(!table && !*table && status_thrown(table) == VNDF_ERROR_DISTRIBUTION && calls >= 100);
    calls = 99;
    TEST(std::isnan(vndf_source_p22(*late, 1)) && vndf_source_p22(*late, 1) == std::exp(-1.0));
    const auto ggx = vndf::own<vndf::source>(vndf_source_family, "ggx");
    for (const bool throws : {false, true}) {
        int told = 0;
        const auto stopped = vndf::build(*ggx, {}, [&](double, const char *) {
            return ++told < 3 ? true : throws ? throw std::runtime_error("enough") : false;
        });
        TEST(!stopped && told == 3);
        TEST_HAS(stopped.message(), "interrupted");
    }
}

} // namespace

int main()
{
    test_distribution();
    test_builds();
    test_callable();
    test_errors();
    test_thrown_by_callables();
    return test_done();
}
