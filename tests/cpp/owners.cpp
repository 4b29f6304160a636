// Owners of vndf.hpp free what they own once, and are empty after a move; results say what went wrong and throw only if
// they are asked to; what a callable throws reaches the caller, and never C.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <vector>

#include "harness/test.h"
#include "vndf.hpp"

// The library's allocations are counted where the linker puts these in the place of those of the C library.
#ifdef VNDF_TEST_WRAP
namespace
{
long allocated;
}
extern "C" {
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void __real_free(void *pointer);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void __wrap_free(void *pointer);

static void *counted(void *pointer)
{
    allocated += pointer != nullptr;
    return pointer;
}
void *__wrap_malloc(size_t size)
{
    return counted(__real_malloc(size));
}
void *__wrap_calloc(size_t count, size_t size)
{
    return counted(__real_calloc(count, size));
}
void *__wrap_realloc(void *old, size_t size)
{
    void *pointer = __real_realloc(old, size);
    allocated += pointer != nullptr && old == nullptr;
    return pointer;
}
void __wrap_free(void *pointer)
{
    allocated -= pointer != nullptr;
    __real_free(pointer);
}
}
#endif

namespace
{

const char table_file[] = VNDF_SOURCE_DIR "/tables/example.vndf";

template <class T>
constexpr bool moves_only = !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T> &&
                            std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T>;
static_assert(moves_only<vndf::distribution> && moves_only<vndf::family> && moves_only<vndf::source>);
static_assert(moves_only<vndf::reference> && moves_only<vndf::albedo>);
static_assert(moves_only<vndf::result<vndf::distribution>>);
// Temporary owners are refused where the value would dangle.
static_assert(std::is_constructible_v<vndf::surface, const vndf::distribution &, float>);
static_assert(!std::is_constructible_v<vndf::surface, vndf::distribution, float>);
static_assert(!std::is_constructible_v<vndf::distribution_ref, vndf::distribution>);
static_assert(std::is_constructible_v<vndf::bsdf, const vndf::material &, vndf::vec3>);
static_assert(!std::is_constructible_v<vndf::bsdf, vndf::material, vndf::vec3>);
static_assert(!std::is_constructible_v<vndf::bsdf, vndf::material, vndf_roughness, vndf::vec3>);
static_assert(!std::is_constructible_v<vndf::bsdf_batch, vndf::material, vndf::vec3>);
static_assert(std::is_trivially_copyable_v<vndf::view> && std::is_trivially_copyable_v<vndf::mixture>);
static_assert(sizeof(vndf::surface) == sizeof(vndf_surface) && sizeof(vndf::view) == sizeof(vndf_view));

// A callable that counts how many of its copies live.
struct counted_law {
    static int alive;
    counted_law() noexcept
    {
        alive++;
    }
    counted_law(const counted_law &) noexcept
    {
        alive++;
    }
    ~counted_law()
    {
        alive--;
    }
    double operator()(double r) const
    {
        return std::exp(-r * r);
    }
};
int counted_law::alive = 0;

// ---- owners ----

void test_distribution()
{
    auto loaded = vndf::distribution::load(table_file);
    if (!TEST(loaded && loaded.status() == VNDF_OK && loaded.message()[0] == '\0'))
        return;
    vndf::distribution first = std::move(*loaded), second;
    TEST(first && !*loaded && loaded->info().bytes == 0);
    const vndf_distribution *pointer = first.get();
    second = std::move(first);
    TEST(second.get() == pointer && !first && first.info().source[0] == '\0' && !first.save("/dev/null"));
    first = *vndf::distribution::load(std::string(table_file)); // frees nothing, then something
    first = std::move(second);
    TEST(first.get() == pointer && !second);
    first = std::move(static_cast<vndf::distribution &>(first));
    TEST(first.get() == pointer);
    vndf_distribution *mine = first.release();
    TEST(mine == pointer && !first && vndf::distribution(mine).info().bytes > 0);
    TEST(!vndf::surface(first, 0.3f).at({0, 0, 1}).valid());
    TEST(vndf::ggx().get() == vndf_ggx() && vndf::beckmann().get() == vndf_beckmann());
}

void test_memory()
{
    const auto table = vndf::distribution::load(table_file);
    const auto bytes = table->save_memory();
    TEST(bytes && bytes->size() == table->info().bytes);
    const auto again = vndf::distribution::load_memory(bytes->data(), bytes->size());
    TEST(again && again->info().scale == table->info().scale);
    const auto numbers = table->numbers();
    TEST(numbers && numbers->size() == vndf_numbers(table->get(), nullptr, 0) && numbers->size() > 100);
    TEST(vndf::ggx().numbers()->empty() && !vndf::ggx().save_memory());
    const auto cut = vndf::distribution::load_memory(bytes->data(), bytes->size() / 2);
    TEST(!cut && cut.status() == VNDF_ERROR_TABLE && !*cut);
}

void test_family()
{
    const auto built = vndf::build_family("student-t", 2.0, 3.0, {0, 2, 2048, false, {}});
    if (!TEST(built && built->size() == 2))
        return;
    const auto bytes = built->save_memory();
    auto read = vndf::family::load_memory(bytes->data(), bytes->size());
    TEST(read && read->knot(1).parameter == 3.0f && read->knot(1).table && read->knot(0).distance > 0);
    const auto between = read->at(2.4f, 0.3f);
    TEST(between.place == VNDF_FAMILY_INSIDE && between.mixture.count == 2);
    TEST(between.mixture.at({0, 0, 1}).valid() && read->at(9.0f, 0.3f).place == VNDF_FAMILY_ABOVE);
    const vndf::family moved = std::move(*read);
    TEST(moved && !*read && read->size() == 0 && read->at(2.4f, 0.3f).place == VNDF_FAMILY_INVALID);
    TEST(!read->save_memory() && !read->knot(0).table);
    const auto two = vndf::family::of({vndf::ggx(), vndf::beckmann()}, {1.0f, 2.0f});
    TEST(two && two->knot(1).table.get() == vndf_beckmann());
    TEST(!vndf::family::of({vndf::ggx()}, {1.0f, 2.0f}) && !vndf::family::load("/no/such/file"));
    const std::vector<vndf::distribution_ref> many(300, vndf::ggx());
    std::vector<float> parameters(300);
    for (std::size_t i = 0; i < 300; i++)
        parameters[i] = (float)i;
    TEST(!vndf::family::of(many, parameters));
}

void test_albedo()
{
    int told = 0;
    const auto built =
        vndf::albedo::build(vndf::ggx(), {0, 8, 8, [&](double, const char *) { return ++told > 0; }});
    if (!TEST(built && told > 3))
        return;
    const auto bytes = built->save_memory();
    auto read = vndf::albedo::load_memory(bytes->data(), bytes->size());
    TEST(read && read->directional(0.3f, 0.5f) == vndf_albedo_directional(built->get(), 0.3f, 0.5f));
    TEST(read->split(0.3f, 0.5f).reflected == read->directional(0.3f, 0.5f));
    TEST(read->average(0.5f) == read->average_split(0.5f).reflected && read->info().columns == 8);
    vndf::description d(vndf::ggx(), 0.5f);
    d.effects.scattering = VNDF_SCATTERING_TURQUIN;
    TEST(!vndf::material::resolve(d));
    d.albedo = read->get();
    TEST(vndf::material::resolve(d));
    const vndf::albedo moved = std::move(*read);
    TEST(moved && !*read && read->directional(0.3f, 0.5f) == 1 && !read->save("/dev/null"));
    const auto stopped = vndf::albedo::build(vndf::ggx(), {0, 8, 8, [](double, const char *) { return false; }});
    TEST(!stopped && stopped.status() == VNDF_ERROR_ARGUMENT && !stopped.thrown());
}

void test_sources()
{
    const auto formula = vndf::source::slope_expression("exp(-k*r)", {{"k", 3.0}});
    const auto same = vndf::source::slope_expression("exp(-k*r)", std::vector<vndf_parameter>{{"k", 3.0}});
    TEST(formula && same && *formula->p22(0.5) == vndf_source_p22(same->get(), 0.5));
    TEST(vndf::source::ndf_expression("c^2") && vndf::source::family("gtr:1.5"));
    TEST(vndf::source::csv_file(VNDF_SOURCE_DIR "/tables/example.csv"));
    TEST(vndf::source::csv_text("mine", "slope,p22\n0,1\n1,0.5\n2,0\n"));
    const double slope[] = {0, 1, 2};
    const std::vector<double> p22 = {1, 0.5, 0};
    auto rows = vndf::source::rows(VNDF_ROWS_OVER_SLOPE, slope, VNDF_ROWS_OF_P22, p22, "mine");
    TEST(rows && *rows->p22(1) == 0.5 && rows->describe("--gauge 7") && rows->description()[2] == 'g');
    TEST(!vndf::source::rows(VNDF_ROWS_OVER_SLOPE, slope, VNDF_ROWS_OF_P22, std::vector<double>(2), "mine"));
    const auto wrong = vndf::source::slope_expression("exp(-k*r");
    TEST(!wrong && wrong.status() == VNDF_ERROR_SYNTAX && !*wrong && wrong->description()[0] == '\0');
    TEST(*wrong->p22(1) == 0 && !vndf::build(*wrong) && !vndf::ggx().certify(*wrong));
    TEST(!vndf::reference::from(*wrong));
    const auto table = vndf::build(*formula, {2048, 0, {}, {}, 0, 3});
    TEST(table && table->info().bytes <= 2048 && table->info().moments == 3 && vndf::source::of(*table));
    TEST(std::strcmp(vndf::source::of(*table)->description(), formula->description()) == 0);
    const auto exact = vndf::reference::from(*formula);
    TEST_RELATIVE(*exact->area(0.0), 1.0, 1e-7);
    TEST(*exact->p22(0.5) > 0 && std::strlen(vndf::family_help()) > 100 && vndf::family_material(0));
    vndf::reference none;
    TEST(*none.p22(1) == 0 && *none.area(1) == 0);
}

void test_callable()
{
    {
        auto made = vndf::source::slope_callback(counted_law(), "a law");
        TEST(made && counted_law::alive == 1);
        const vndf::source moved = std::move(*made);
        TEST(!*made && *moved.p22(0.5) == std::exp(-0.25) && counted_law::alive == 1);
        vndf::source other = *vndf::source::ndf_callback([](double c) { return c; }, "a cosine");
        TEST(*other.p22(0.0) == 1.0);
        other = *vndf::source::slope_callback(counted_law(), "another");
        TEST(counted_law::alive == 2 && *other.p22(0.0) == 1.0);
    }
    TEST(counted_law::alive == 0);
    const auto source = vndf::source::slope_callback(counted_law(), "a law");
    const auto table = vndf::build(*source, {2048, 0, {}, {1.0}, 0.01});
    TEST(table && table->info().certificate.hidden > 0);
    TEST_HAS(table->info().source, "a law");
}

// ---- errors ----

template <class Call> int thrown_status(const Call &call)
{
    try {
        call();
    } catch (const vndf::error &e) {
        return e.what()[0] ? (int)e.status() : -2;
    }
    return -1;
}

void test_throwing()
{
    TEST(thrown_status([] { vndf::distribution::load("/no/such/file").value(); }) == VNDF_ERROR_IO);
    TEST(thrown_status([] { vndf::or_throw(vndf::distribution::load("/no/such/file")); }) == VNDF_ERROR_IO);
    TEST(thrown_status([] { vndf::or_throw(vndf::distribution::load(table_file)); }) == -1);
    TEST(thrown_status([] { vndf::or_throw(vndf::ggx().save("/dev/null")); }) == VNDF_ERROR_ARGUMENT);
    const vndf::distribution table = vndf::or_throw(vndf::distribution::load(table_file));
    TEST(table);
    const auto failed = vndf::material::resolve(vndf::description(vndf::ggx(), 0.2f).schlick({}));
    TEST(!failed && thrown_status([&] { failed.check(); }) == VNDF_ERROR_ARGUMENT);
    TEST(!vndf::bsdf(*failed, {0, 0, 1}));
    const vndf::material nothing;
    TEST(!vndf::bsdf(nothing, {0, 0, 1}) && vndf::bsdf(nothing, {0, 0, 1}).eval({0, 0, 1})[0] == 0);
    const auto uneven = vndf::description(vndf::ggx(), 0.2f).conductor({0.2f, 0.3f}, {3.0f});
    TEST(!vndf::material::resolve(uneven) && !vndf::material::resolve({}));
    TEST(vndf::material::resolve(vndf::description(vndf::ggx(), 0.2f).conductor({0.2f}, {3.0f}))->wavelengths() ==
         1);
}

struct mine {
    int number;
};

template <class T> int number_thrown(const vndf::result<T> &failed)
{
    if (failed || !failed.thrown() || failed.status() != VNDF_ERROR_ARGUMENT)
        return -1;
    try {
        failed.check();
    } catch (const mine &m) {
        return m.number;
    }
    return -2;
}

void test_thrown_by_callables()
{
    int calls = 0;
    const auto late = vndf::source::slope_callback(
        [&](double r) -> double {
            if (++calls == 100)
                throw mine{7};
            return std::exp(-r);
        },
        "late");
    const auto table = vndf::build(*late);
    TEST(number_thrown(table) == 7 && calls == 100 && !*table);
    TEST_HAS(table.message(), "threw");
    calls = 99;
    TEST(number_thrown(late->p22(1)) == 7 && late->p22(1));
    calls = 99;
    TEST(number_thrown(vndf::reference::from(*late)) == 7);
    const auto known =
        vndf::source::slope_callback([](double) -> double { throw std::runtime_error("no such brdf"); }, "known");
    TEST_HAS(vndf::build(*known).message(), "no such brdf");
    TEST_HAS(vndf::build(*vndf::source::slope_callback(vndf::source::density(), "empty")).message(), "threw");
    vndf::build_options options;
    options.progress = [](double done, const char *) -> bool { return done < 0.01 ? true : throw mine{8}; };
    TEST(number_thrown(vndf::build(*vndf::source::family("ggx"), options)) == 8);
    options.progress = [](double, const char *) { return false; };
    const auto stopped = vndf::build(*vndf::source::family("ggx"), options);
    TEST(!stopped && !stopped.thrown());
    TEST_HAS(stopped.message(), "interrupted");
    TEST(number_thrown(vndf::build_family(
             "student-t", 2.0, 3.0, {0, 2, 2048, false, [](double, const char *) -> bool { throw mine{9}; }})) ==
         9);
}

// A callable that builds: what is thrown inside stays inside.
void test_nested()
{
    const auto inner = vndf::source::slope_callback([](double) -> double { throw mine{1}; }, "inner");
    const auto outer =
        vndf::source::slope_callback([&](double r) { return inner->p22(r) ? 0.0 : std::exp(-r); }, "outer");
    TEST(*outer->p22(0.0) == 1.0 && outer->p22(1.0));
}

// Without VNDF_TEST_WRAP the sanitizer counts, or nobody does.
template <class Test> void without_leaks(const Test &test)
{
#ifdef VNDF_TEST_WRAP
    const long before = allocated;
    test();
    TEST(allocated == before);
#else
    test();
#endif
}

} // namespace

int main()
{
    for (void (*test)() : {test_distribution, test_memory, test_family, test_albedo, test_sources, test_callable,
                           test_throwing, test_thrown_by_callables, test_nested})
        without_leaks(test);
    return test_done();
}
