// vndf.hpp - the library in C++17: owners that free, values with member functions, batches over spans.
//
// All of vndf.h, vndf_bsdf.h, vndf_albedo.h and vndf_build.h, whose comments hold here: units, ranges, promises. This
// header adds no state and no arithmetic: every number has the bits of the C call of the same name. It needs the C
// headers, the standard library of C++17 and no other file; it compiles without exceptions and without RTTI.
//
//     #include <cmath>
//     #include <cstdio>
//     #include <vector>
//     #include <vndf.hpp>
//
//     int main()
//     {
//         const auto law = [k = 3.0](double r) { return std::exp(-k * r) * (1 + 0.8 * std::cos(6 * r)); };
//         const auto source = vndf::source::slope_callback(law, "wavy");
//         const auto table = vndf::build(*source);
//         if (!table)
//             return std::puts(table.message()), 1;
//         const vndf::surface metal(*table, 0.3f, 0.1f);
//         const vndf::view view = metal.at({0.6f, 0.0f, 0.8f});
//         const auto [wm, pdf] = view.sample(0.25f, 0.5f);
//         std::vector<float> u1(1000, 0.25f), u2(1000, 0.5f), x(1000), y(1000), z(1000), density(1000);
//         const vndf::batch many(*table, 0.3f, 0.1f, vndf::vec3{0.6f, 0.0f, 0.8f});
//         if (const auto drawn = many.sample(u1, u2, {x, y, z}, density); !drawn)
//             return std::puts(drawn.message()), 1;
//         std::printf("%g %g %g %g\n", wm.x - x[0], wm.y - y[0], wm.z - z[0], pdf - density[0]);
//     }
//
// prints four zeros.
//
// Errors. What can fail returns a vndf::result: it converts to true or false, *result is the value, message() says
// what went wrong. Nothing throws unless it is asked to: result.value(), result.check() and vndf::or_throw(result)
// throw vndf::error. The value of a failed result is empty, and so is an owner that was moved from: every call on it is
// safe, and answers as the C call answers NULL.
//
// Callables. Sources, and the progress of builds, take lambdas; a source keeps its own alive. What they throw does
// not cross C: it is caught, the build stops, and the result holds the exception; value(), check() and or_throw throw
// it again.
//
// Owners are move-only: distribution, family, source, reference, albedo. Values hold pointers to what they were made
// from, which must outlive them, as in C: a surface its distribution, a family its distributions, a bsdf its material,
// which must not move either. Temporary owners are refused where that would dangle. Owners are as safe for threads
// as in C; a callable that several threads use at once has to allow it.
//
// Map: results, distributions, surfaces, affine surfaces, mixtures, families, sources, building, albedos, materials,
// spans, batches of surfaces, batches of hits.
#ifndef VNDF_HPP
#define VNDF_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#if __cplusplus >= 202002L && defined(__has_include)
#  if __has_include(<span>)
#    include <span>
#  endif
#endif

#include "vndf.h"
#include "vndf_albedo.h"
#include "vndf_bsdf.h"
#include "vndf_build.h"

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#  define VNDF_HPP_EXCEPTIONS 1
#else
#  define VNDF_HPP_EXCEPTIONS 0
#endif

namespace vndf
{

using vec3 = vndf_vec3;

// The version of the library that runs; the macro VNDF_VERSION is that of the headers.
inline const char *version() noexcept
{
    return vndf_version();
}

// ---- results --------------------------------------------------------------------------------------

#if VNDF_HPP_EXCEPTIONS
// A failed call as an exception, for those who ask for one.
class error : public std::runtime_error
{
  public:
    explicit error(const vndf_error &what) : std::runtime_error(what.message), status_(what.status) {}
    vndf_status status() const noexcept { return status_; }

  private:
    vndf_status status_;
};
#endif

// Whether a call went well, and what went wrong.
class outcome
{
  public:
    outcome() noexcept
    {
        error_.status = VNDF_OK;
        error_.message[0] = '\0';
    }
    outcome(const vndf_error &error, std::exception_ptr thrown) noexcept
        : error_(error), thrown_(std::move(thrown))
    {
    }
    explicit operator bool() const noexcept { return error_.status == VNDF_OK; }
    vndf_status status() const noexcept { return error_.status; }
    // In words for people; empty if nothing went wrong.
    const char *message() const noexcept { return error_.message; }
    const vndf_error &failure() const noexcept { return error_; }
    // What a callable threw meanwhile, or null.
    std::exception_ptr thrown() const noexcept { return thrown_; }
#if VNDF_HPP_EXCEPTIONS
    // Throws what a callable threw, or vndf::error; nothing if all went well.
    void check() const
    {
        if (thrown_)
            std::rethrow_exception(thrown_);
        if (error_.status != VNDF_OK)
            throw error(error_);
    }
#endif

  private:
    vndf_error error_;
    std::exception_ptr thrown_;
};

// A value, or what went wrong and an empty value.
template <class T> class [[nodiscard]] result : public outcome
{
  public:
    result(T value) noexcept : value_(std::move(value)) {}
    result(outcome failed) noexcept : outcome(std::move(failed)) {}
    T &operator*() &noexcept { return value_; }
    const T &operator*() const &noexcept { return value_; }
    T &&operator*() &&noexcept { return std::move(value_); }
    T *operator->() noexcept { return &value_; }
    const T *operator->() const noexcept { return &value_; }
#if VNDF_HPP_EXCEPTIONS
    T &value() &
    {
        check();
        return value_;
    }
    const T &value() const &
    {
        check();
        return value_;
    }
    T value() &&
    {
        check();
        return std::move(value_);
    }
#endif

  private:
    T value_{};
};

template <> class [[nodiscard]] result<void> : public outcome
{
  public:
    result() noexcept = default;
    result(outcome failed) noexcept : outcome(std::move(failed)) {}
#if VNDF_HPP_EXCEPTIONS
    void value() const
    {
        check();
    }
#endif
};

#if VNDF_HPP_EXCEPTIONS
template <class T> T or_throw(result<T> &&given)
{
    return std::move(given).value();
}
#endif

namespace detail
{

inline outcome failed(vndf_status status, const char *message) noexcept
{
    vndf_error error;
    error.status = status;
    std::snprintf(error.message, sizeof error.message, "%s", message);
    return outcome(error, nullptr);
}

// While it lives, callables that C calls on this thread leave here what they throw. Calls may nest.
class shield
{
  public:
    shield() noexcept : outer_(innermost()) { innermost() = this; }
    ~shield() { innermost() = outer_; }
    shield(const shield &) = delete;
    shield &operator=(const shield &) = delete;

    static bool hit() noexcept { return innermost() && innermost()->thrown_; }
    const std::exception_ptr &thrown() const noexcept { return thrown_; }
    // What call() returns; `otherwise` if it throws, or something before it has thrown.
    template <class R, class Call> static R guard(R otherwise, const Call &call) noexcept
    {
        if (hit())
            return otherwise;
#if VNDF_HPP_EXCEPTIONS
        try {
            return call();
        } catch (...) {
            if (innermost())
                innermost()->thrown_ = std::current_exception();
            return otherwise;
        }
#else
        return call();
#endif
    }

  private:
    static shield *&innermost() noexcept
    {
        static thread_local shield *current = nullptr;
        return current;
    }
    shield *outer_;
    std::exception_ptr thrown_;
};

inline void describe(const std::exception_ptr &thrown, vndf_error *error) noexcept
{
    const char *text = "something that is no std::exception";
    error->status = VNDF_ERROR_ARGUMENT;
#if VNDF_HPP_EXCEPTIONS
    try {
        std::rethrow_exception(thrown);
    } catch (const std::exception &known) {
        std::snprintf(error->message, sizeof error->message, "a callable threw: %s", known.what());
        return;
    } catch (...) {
    }
#else
    static_cast<void>(thrown);
#endif
    std::snprintf(error->message, sizeof error->message, "a callable threw %s", text);
}

// Owner of what call(&error) returns, a pointer of C; the error, or what a callable threw, if there is one.
template <class Owner, class Call> result<Owner> own(const Call &call) noexcept
{
    vndf_error error = {VNDF_OK, ""};
    const shield here;
    Owner owner(call(&error));
    if (here.thrown())
        describe(here.thrown(), &error);
    else if (owner)
        return owner;
    return outcome(error, here.thrown());
}

// The same for calls that return a status, and for those that return a number.
template <class Call> result<void> status_of(const Call &call) noexcept
{
    vndf_error error = {VNDF_OK, ""};
    const shield here;
    if (call(&error) == VNDF_OK && !here.thrown())
        return {};
    if (here.thrown())
        describe(here.thrown(), &error);
    return outcome(error, here.thrown());
}

template <class Call> result<double> number_of(const Call &call) noexcept
{
    vndf_error error = {VNDF_OK, ""};
    const shield here;
    const double number = call();
    if (!here.thrown())
        return number;
    describe(here.thrown(), &error);
    return outcome(error, here.thrown());
}

// What make() returns; no memory is an error like any other.
template <class T, class Make> result<T> allocated(const Make &make) noexcept
{
#if VNDF_HPP_EXCEPTIONS
    try {
        return result<T>(make());
    } catch (const std::bad_alloc &) {
        return failed(VNDF_ERROR_MEMORY, "no memory");
    } catch (...) {
        vndf_error error;
        describe(std::current_exception(), &error);
        return outcome(error, std::current_exception());
    }
#else
    return result<T>(make());
#endif
}

// `size` bytes that save(bytes, &error) writes.
template <class Save> result<std::vector<std::byte>> bytes_of(std::size_t size, const Save &save) noexcept
{
    auto bytes = allocated<std::vector<std::byte>>([&] { return std::vector<std::byte>(size ? size : 1); });
    if (!bytes)
        return bytes;
    const auto saved = status_of([&](vndf_error *error) { return save(bytes->data(), error); });
    return saved ? std::move(bytes) : result<std::vector<std::byte>>(saved);
}

struct freer {
    void operator()(vndf_family *family) const noexcept { vndf_family_free(family); }
    void operator()(vndf_source *source) const noexcept { vndf_source_free(source); }
    void operator()(vndf_reference *reference) const noexcept { vndf_reference_free(reference); }
    void operator()(vndf_albedo *albedo) const noexcept { vndf_albedo_free(albedo); }
};

// A move-only owner of a T of C.
template <class T> class handle
{
  public:
    handle() noexcept = default;
    explicit handle(T *owned) noexcept : owned_(owned) {}
    explicit operator bool() const noexcept { return owned_ != nullptr; }
    const T *get() const noexcept { return owned_.get(); }
    // Hands it to the caller, who frees it.
    T *release() noexcept { return owned_.release(); }

  protected:
    T *owned() noexcept { return owned_.get(); }

  private:
    std::unique_ptr<T, freer> owned_;
};

} // namespace detail

// ---- distributions --------------------------------------------------------------------------------

// A text that ends with a zero, for the time of a call.
class text
{
  public:
    text(const char *given) noexcept : c_(given) {}
    text(const std::string &given) noexcept : c_(given.c_str()) {}
    const char *c_str() const noexcept { return c_; }

  private:
    const char *c_;
};

class distribution;
class source;

// A distribution that somebody else owns, or a closed form: what surfaces are made from. Null is allowed.
class distribution_ref
{
  public:
    distribution_ref() noexcept = default;
    distribution_ref(const vndf_distribution *given) noexcept : pointer_(given) {}
    distribution_ref(const distribution &&temporary) = delete; // it would be gone
    explicit operator bool() const noexcept { return pointer_ != nullptr; }
    const vndf_distribution *get() const noexcept { return pointer_; }
    vndf_info info() const noexcept { return vndf_distribution_info(pointer_); }
    // What the kernels of `vndf export` read; empty for a closed form.
    result<std::vector<float>> numbers() const noexcept
    {
        return detail::allocated<std::vector<float>>([&] {
            std::vector<float> all(vndf_numbers(pointer_, nullptr, 0));
            vndf_numbers(pointer_, all.data(), all.size());
            return all;
        });
    }
    result<void> save(text path) const noexcept
    {
        return detail::status_of([&](vndf_error *error) { return vndf_save(pointer_, path.c_str(), error); });
    }
    // For distribution::load_memory.
    result<std::vector<std::byte>> save_memory() const noexcept
    {
        const std::size_t size = info().bytes;
        return detail::bytes_of(
            size, [&](void *to, vndf_error *error) { return vndf_save_memory(pointer_, to, size, error); });
    }
    // The certificate, measured against a source.
    result<vndf_certificate> certify(const source &against) const noexcept;

  private:
    const vndf_distribution *pointer_ = nullptr;
};

// Owns a table. It converts to a distribution_ref.
class distribution : public distribution_ref
{
  public:
    distribution() noexcept = default;
    // Takes over what a call of C returned.
    explicit distribution(vndf_distribution *owned) noexcept : distribution_ref(owned) {}
    distribution(distribution &&other) noexcept : distribution_ref(other.release()) {}
    distribution &operator=(distribution &&other) noexcept
    {
        if (this != &other) {
            vndf_free(release());
            distribution_ref::operator=(distribution_ref(other.release()));
        }
        return *this;
    }
    ~distribution() { vndf_free(release()); }
    // Hands it to the caller, who frees it by vndf_free.
    vndf_distribution *release() noexcept
    {
        vndf_distribution *owned = const_cast<vndf_distribution *>(get());
        distribution_ref::operator=(distribution_ref());
        return owned;
    }

    static result<distribution> load(text path) noexcept
    {
        return detail::own<distribution>([&](vndf_error *error) { return vndf_load(path.c_str(), error); });
    }
    static result<distribution> load_memory(const void *bytes, std::size_t size) noexcept
    {
        return detail::own<distribution>([&](vndf_error *error) { return vndf_load_memory(bytes, size, error); });
    }
};

// The closed forms; nobody owns them.
inline distribution_ref ggx() noexcept
{
    return vndf_ggx();
}

inline distribution_ref beckmann() noexcept
{
    return vndf_beckmann();
}

// ---- surfaces -------------------------------------------------------------------------------------

// Results of several numbers, for structured bindings: auto [wm, pdf] = view.sample(u1, u2).
struct drawn {
    vec3 wm;
    float pdf;
};

struct weighted {
    vec3 wm;
    float pdf, weight;
};

struct uniforms {
    float u1, u2;
};

// vndf_view with its calls.
class view : public vndf_view
{
  public:
    view(const vndf_surface &surface, vec3 from) noexcept : vndf_view(vndf_view_from(&surface, from)) {}
    bool valid() const noexcept { return vndf_view::distribution != nullptr; }
    drawn sample(float u1, float u2) const noexcept
    {
        drawn d;
        d.wm = vndf_sample(this, u1, u2, &d.pdf);
        return d;
    }
    weighted sample_weight(float u1, float u2) const noexcept
    {
        weighted w;
        w.wm = vndf_sample_weight(this, u1, u2, &w.pdf, &w.weight);
        return w;
    }
    float pdf(vec3 wm) const noexcept { return vndf_pdf(this, wm); }
    float visible(vec3 wm) const noexcept { return vndf_visible(this, wm); }
    uniforms invert(vec3 wm) const noexcept
    {
        uniforms u;
        vndf_invert(this, wm, &u.u1, &u.u2);
        return u;
    }
};

// vndf_surface with its calls.
class surface : public vndf_surface
{
  public:
    surface(distribution_ref of, float along_x, float along_y) noexcept : vndf_surface{of.get(), along_x, along_y}
    {
    }
    surface(distribution_ref of, float alpha) noexcept : surface(of, alpha, alpha) {}
    view at(vec3 wi) const noexcept { return view(*this, wi); }
    float ndf(vec3 wm) const noexcept { return vndf_ndf(this, wm); }
    float p22(float x, float y) const noexcept { return vndf_p22(this, x, y); }
    float projected_area(vec3 w) const noexcept { return vndf_projected_area(this, w); }
    float lambda(vec3 w) const noexcept { return vndf_lambda(this, w); }
    float g1(vec3 w) const noexcept { return vndf_g1(this, w); }
    float g2(vec3 wi, vec3 wo, vndf_g2_model model = VNDF_G2_HEIGHT_CORRELATED) const noexcept
    {
        return vndf_g2(this, wi, wo, model);
    }
};

// ---- affine surfaces ------------------------------------------------------------------------------

// vndf_affine_view with its calls.
class affine_view : public vndf_affine_view
{
  public:
    affine_view(const vndf_affine &surface, vec3 from) noexcept
        : vndf_affine_view(vndf_affine_view_from(&surface, from))
    {
    }
    bool valid() const noexcept { return vndf_view::distribution != nullptr; }
    drawn sample(float u1, float u2) const noexcept
    {
        drawn d;
        d.wm = vndf_affine_sample(this, u1, u2, &d.pdf);
        return d;
    }
    float pdf(vec3 wm) const noexcept { return vndf_affine_pdf(this, wm); }
    float visible(vec3 wm) const noexcept { return vndf_affine_visible(this, wm); }
    uniforms invert(vec3 wm) const noexcept
    {
        uniforms u;
        vndf_affine_invert(this, wm, &u.u1, &u.u2);
        return u;
    }
};

// Slopes s = M u + mean, M = (xx xy; yx yy).
struct matrix {
    float xx, xy, yx, yy;
};

struct slope {
    float x, y;
};

// vndf_affine with its calls.
class affine : public vndf_affine
{
  public:
    affine(distribution_ref of, matrix m, slope mean = {0.0f, 0.0f}) noexcept
        : vndf_affine{of.get(), m.xx, m.xy, m.yx, m.yy, mean.x, mean.y}
    {
    }
    affine_view at(vec3 wi) const noexcept { return affine_view(*this, wi); }
    float ndf(vec3 wm) const noexcept { return vndf_affine_ndf(this, wm); }
    float p22(float x, float y) const noexcept { return vndf_affine_p22(this, x, y); }
    float projected_area(vec3 w) const noexcept { return vndf_affine_projected_area(this, w); }
    float lambda(vec3 w) const noexcept { return vndf_affine_lambda(this, w); }
    float g1(vec3 w) const noexcept { return vndf_affine_g1(this, w); }
    float g2(vec3 wi, vec3 wo, vndf_g2_model model = VNDF_G2_HEIGHT_CORRELATED) const noexcept
    {
        return vndf_affine_g2(this, wi, wo, model);
    }
};

// ---- mixtures -------------------------------------------------------------------------------------

// `lobe` is the one that was drawn or inverted, -1 of what is invalid.
struct drawn_of_lobe {
    vec3 wm;
    float pdf;
    int lobe;
};

struct uniforms_of_lobe {
    float u1, u2;
    int lobe;
};

// vndf_mixture_view with its calls.
class mixture_view : public vndf_mixture_view
{
  public:
    mixture_view(const vndf_mixture &mixture, vec3 from) noexcept
        : vndf_mixture_view(vndf_mixture_view_from(&mixture, from))
    {
    }
    bool valid() const noexcept { return count > 0; }
    drawn_of_lobe sample(float u1, float u2) const noexcept
    {
        drawn_of_lobe d;
        d.wm = vndf_mixture_sample(this, u1, u2, &d.pdf, &d.lobe);
        return d;
    }
    float pdf(vec3 wm) const noexcept { return vndf_mixture_pdf(this, wm); }
    float visible(vec3 wm) const noexcept { return vndf_mixture_visible(this, wm); }
    uniforms_of_lobe invert(vec3 wm, int of_lobe = -1) const noexcept
    {
        uniforms_of_lobe u;
        u.lobe = vndf_mixture_invert(this, wm, of_lobe, &u.u1, &u.u2);
        return u;
    }
};

// vndf_mixture with its calls; it begins without lobes.
class mixture : public vndf_mixture
{
  public:
    mixture() noexcept : vndf_mixture{} {}
    // One more lobe, or the lobes of another mixture, of which each weighs `part` of what it did. False, and nothing
    // is added, if there are too many.
    bool add(const vndf_affine &surface, float weight = 1.0f) noexcept
    {
        if (count < 0 || count >= VNDF_MIXTURE_LOBES)
            return false;
        lobe[count++] = vndf_mixture_lobe{surface, weight};
        return true;
    }
    bool add(const vndf_mixture &other, float part = 1.0f) noexcept
    {
        const int more = other.count;
        if (count < 0 || more < 0 || more > VNDF_MIXTURE_LOBES - count)
            return false;
        for (int i = 0; i < more; i++)
            add(other.lobe[i].surface, other.lobe[i].weight * part);
        return true;
    }
    mixture_view at(vec3 wi) const noexcept { return mixture_view(*this, wi); }
    float ndf(vec3 wm) const noexcept { return vndf_mixture_ndf(this, wm); }
    float p22(float x, float y) const noexcept { return vndf_mixture_p22(this, x, y); }
    float projected_area(vec3 w) const noexcept { return vndf_mixture_projected_area(this, w); }
    float lambda(vec3 w) const noexcept { return vndf_mixture_lambda(this, w); }
    float g1(vec3 w) const noexcept { return vndf_mixture_g1(this, w); }
    float g2(vec3 wi, vec3 wo, vndf_g2_model model = VNDF_G2_HEIGHT_CORRELATED) const noexcept
    {
        return vndf_mixture_g2(this, wi, wo, model);
    }
};

// ---- families -------------------------------------------------------------------------------------

// The family at a parameter; valid while the family lives.
struct placed {
    vndf::mixture mixture;
    vndf_family_place place;
};

// A knot of a family, which owns its distribution.
struct knot {
    float parameter;
    distribution_ref table;
    float distance; // to the next knot
};

// Owns a family of distributions.
class family : public detail::handle<vndf_family>
{
  public:
    using handle::handle;
    static result<family> load(text path) noexcept
    {
        return detail::own<family>([&](vndf_error *error) { return vndf_family_load(path.c_str(), error); });
    }
    static result<family> load_memory(const void *bytes, std::size_t size) noexcept
    {
        return detail::own<family>([&](vndf_error *error) { return vndf_family_load_memory(bytes, size, error); });
    }
    // As many distributions as parameters; the distributions must outlive the family.
    static result<family> of(const std::vector<distribution_ref> &tables,
                             const std::vector<float> &parameters) noexcept
    {
        std::array<const vndf_distribution *, VNDF_LIMIT_FAMILY_KNOTS> pointers = {};
        if (tables.size() != parameters.size())
            return detail::failed(VNDF_ERROR_ARGUMENT, "a family has as many parameters as distributions");
        for (std::size_t i = 0; i < tables.size() && i < pointers.size(); i++)
            pointers[i] = tables[i].get();
        return detail::own<family>([&](vndf_error *error) { // refuses more than the limit before it reads them
            return vndf_family_of(pointers.data(), parameters.data(), tables.size(), error);
        });
    }
    vndf_family_facts info() const noexcept { return vndf_family_info(get()); }
    std::size_t size() const noexcept { return info().count; }
    vndf::knot knot(std::size_t index) const noexcept
    {
        return {vndf_family_parameter(get(), index), vndf_family_distribution(get(), index),
                vndf_family_distance(get(), index)};
    }
    // The distribution of `shape` is not read.
    placed at(float parameter, const vndf_affine &shape) const noexcept
    {
        placed p;
        p.place = vndf_family_at(get(), parameter, &shape, &p.mixture);
        return p;
    }
    placed at(float parameter, float alpha) const noexcept
    {
        return at(parameter, affine(nullptr, {alpha, 0.0f, 0.0f, alpha}));
    }
    result<void> save(text path) const noexcept
    {
        return detail::status_of([&](vndf_error *error) { return vndf_family_save(get(), path.c_str(), error); });
    }
    result<std::vector<std::byte>> save_memory() const noexcept
    {
        const std::size_t size = info().bytes;
        return detail::bytes_of(
            size, [&](void *to, vndf_error *error) { return vndf_family_save_memory(get(), to, size, error); });
    }
};

// ---- sources --------------------------------------------------------------------------------------

// Owns what a table is built from, and the callable behind it.
class source : public detail::handle<vndf_source>
{
  public:
    using handle::handle;
    using density = std::function<double(double)>;

    // Formulas, with named numbers: {{"k", 3.0}}, or a vector of them.
    static result<source> ndf_expression(text formula, std::initializer_list<vndf_parameter> set = {}) noexcept
    {
        return made([&](vndf_error *error) {
            return vndf_source_ndf_expression(formula.c_str(), set.begin(), set.size(), error);
        });
    }
    static result<source> ndf_expression(text formula, const std::vector<vndf_parameter> &set) noexcept
    {
        return made([&](vndf_error *error) {
            return vndf_source_ndf_expression(formula.c_str(), set.data(), set.size(), error);
        });
    }
    static result<source> slope_expression(text formula, std::initializer_list<vndf_parameter> set = {}) noexcept
    {
        return made([&](vndf_error *error) {
            return vndf_source_slope_expression(formula.c_str(), set.begin(), set.size(), error);
        });
    }
    static result<source> slope_expression(text formula, const std::vector<vndf_parameter> &set) noexcept
    {
        return made([&](vndf_error *error) {
            return vndf_source_slope_expression(formula.c_str(), set.data(), set.size(), error);
        });
    }
    static result<source> csv_file(text path) noexcept
    {
        return made([&](vndf_error *error) { return vndf_source_csv_file(path.c_str(), error); });
    }
    static result<source> csv_text(text name, std::string_view rows) noexcept
    {
        return made([&](vndf_error *error) {
            return vndf_source_csv_text(name.c_str(), rows.data(), rows.size(), error);
        });
    }
    // Two containers of doubles of one length: vectors, arrays, spans.
    template <class Places, class Values>
    static result<source> rows(vndf_rows_over over, const Places &x, vndf_rows_of of, const Values &value,
                               text name) noexcept
    {
        if (std::size(x) != std::size(value))
            return detail::failed(VNDF_ERROR_ARGUMENT, "rows have as many places as values");
        return made([&](vndf_error *error) {
            return vndf_source_rows(over, of, std::data(x), std::data(value), std::size(x), name.c_str(), error);
        });
    }
    static result<source> family(text specification) noexcept
    {
        return made([&](vndf_error *error) { return vndf_source_family(specification.c_str(), error); });
    }
    // D(cos theta_m), and P22(r), as anything that is called with a double and returns one. It is kept alive.
    template <class Callable> static result<source> ndf_callback(Callable &&ndf, text name) noexcept
    {
        return of_callable(std::forward<Callable>(ndf), name, vndf_source_ndf_callback);
    }
    template <class Callable> static result<source> slope_callback(Callable &&p22, text name) noexcept
    {
        return of_callable(std::forward<Callable>(p22), name, vndf_source_slope_callback);
    }
    static result<source> of(distribution_ref table) noexcept
    {
        return made([&](vndf_error *error) { return vndf_source_of(table.get(), error); });
    }
    // As it was given, before normalisation; 0 of an empty source.
    result<double> p22(double r) const noexcept
    {
        return detail::number_of([&] { return *this ? vndf_source_p22(get(), r) : 0.0; });
    }
    const char *description() const noexcept { return *this ? vndf_source_description(get()) : ""; }
    result<void> describe(text words) noexcept
    {
        return detail::status_of(
            [&](vndf_error *error) { return vndf_source_describe(owned(), words.c_str(), error); });
    }
    // C does not know the callable, so it cannot be handed over.
    vndf_source *release() = delete;

  private:
    template <class Call> static result<source> made(const Call &call) noexcept
    {
        return detail::own<source>(call);
    }
    static double evaluate(double x, void *user) noexcept
    {
        const density &called = *static_cast<const density *>(user);
        return detail::shield::guard(std::numeric_limits<double>::quiet_NaN(), [&] { return called(x); });
    }
    template <class Callable, class Make>
    static result<source> of_callable(Callable &&given, text name, const Make &make) noexcept
    {
        auto kept = detail::allocated<std::unique_ptr<density>>(
            [&] { return std::make_unique<density>(std::forward<Callable>(given)); });
        if (!kept)
            return outcome(kept);
        auto all = made([&](vndf_error *error) { return make(evaluate, kept->get(), name.c_str(), error); });
        all->callable_ = std::move(*kept);
        return all;
    }
    // Freed before the source of C, which does not call it any more.
    std::unique_ptr<density> callable_;
};

// ---- building -------------------------------------------------------------------------------------

// Told how far a build is, in [0, 1], and its stage. True: go on; false: stop.
using progress = std::function<bool(double done, const char *what)>;

namespace detail
{
// A vndf_progress and a vndf_albedo_progress; `user` is a vndf::progress, which may be empty.
inline int go_on(double done, const char *what, void *user) noexcept
{
    const progress &told = *static_cast<const progress *>(user);
    if (!told)
        return shield::hit();
    return shield::guard(1, [&] { return told(done, what) ? 0 : 1; });
}

inline void *user_of(const progress &told) noexcept
{
    return const_cast<progress *>(&told);
}
} // namespace detail

// vndf_build_options; as they are here they are the defaults.
struct build_options {
    std::size_t max_bytes = 0;
    double max_tv = 0;
    vndf::progress progress = {};
    std::vector<double> breaks = {};
    double finest = 0;
    int moments = 0;
};

inline result<distribution> build(const source &from, const build_options &options = {}) noexcept
{
    vndf_build_options c = {};
    c.max_bytes = options.max_bytes;
    c.max_tv = options.max_tv;
    c.progress = detail::go_on;
    c.progress_user = detail::user_of(options.progress);
    c.breaks = options.breaks.data();
    c.break_count = options.breaks.size();
    c.finest = options.finest;
    c.moments = options.moments;
    return detail::own<distribution>(
        [&](vndf_error *error) { return vndf_build(from.get(), &c, nullptr, error); });
}

inline result<vndf_certificate> distribution_ref::certify(const source &against) const noexcept
{
    vndf_certificate certificate = {};
    if (!against)
        return detail::failed(VNDF_ERROR_ARGUMENT, "the source is empty");
    const auto measured = detail::status_of(
        [&](vndf_error *error) { return vndf_certify(pointer_, against.get(), &certificate, error); });
    return measured ? result<vndf_certificate>(certificate) : result<vndf_certificate>(outcome(measured));
}

// vndf_family_options; as they are here they are the defaults.
struct family_options {
    double max_distance = 0;
    std::size_t knots = 0;
    std::size_t max_bytes = 0;
    int moments = 0;
    vndf::progress progress = {};
};

inline result<family> build_family(text specification, double low, double high,
                                   const family_options &options = {}) noexcept
{
    vndf_family_options c = {};
    c.max_distance = options.max_distance;
    c.knots = options.knots;
    c.max_bytes = options.max_bytes;
    c.moments = options.moments;
    c.progress = detail::go_on;
    c.progress_user = detail::user_of(options.progress);
    return detail::own<family>(
        [&](vndf_error *error) { return vndf_build_family(specification.c_str(), low, high, &c, error); });
}

// The slow oracle of a source, which must outlive it.
class reference : public detail::handle<vndf_reference>
{
  public:
    using handle::handle;
    static result<reference> from(const source &given) noexcept
    {
        if (!given)
            return detail::failed(VNDF_ERROR_ARGUMENT, "the source is empty");
        return detail::own<reference>([&](vndf_error *error) { return vndf_reference_from(given.get(), error); });
    }
    static result<reference> from(const source &&temporary) = delete; // it would be gone
    result<double> p22(double r) const noexcept
    {
        return detail::number_of([&] { return *this ? vndf_reference_p22(get(), r) : 0.0; });
    }
    result<double> area(double theta) const noexcept
    {
        return detail::number_of([&] { return *this ? vndf_reference_area(get(), theta) : 0.0; });
    }
};

// Static texts: one line per family; the names of measured materials, null past the last.
inline const char *family_help() noexcept
{
    return vndf_family_help();
}

inline const char *family_material(std::size_t index) noexcept
{
    return vndf_family_material(index);
}

// ---- albedos --------------------------------------------------------------------------------------

// vndf_albedo_options; as they are here they are the defaults.
struct albedo_options {
    float eta = 0;
    int columns = 0, rows = 0;
    vndf::progress progress = {};
};

// Owns a table of albedos.
class albedo : public detail::handle<vndf_albedo>
{
  public:
    using handle::handle;
    static result<albedo> build(distribution_ref of, const albedo_options &options = {}) noexcept
    {
        vndf_albedo_options c = {};
        c.eta = options.eta;
        c.columns = options.columns;
        c.rows = options.rows;
        c.progress = detail::go_on;
        c.progress_user = detail::user_of(options.progress);
        return detail::own<albedo>([&](vndf_error *error) { return vndf_albedo_build(of.get(), &c, error); });
    }
    static result<albedo> load(text path) noexcept
    {
        return detail::own<albedo>([&](vndf_error *error) { return vndf_albedo_load(path.c_str(), error); });
    }
    static result<albedo> load_memory(const void *bytes, std::size_t size) noexcept
    {
        return detail::own<albedo>([&](vndf_error *error) { return vndf_albedo_load_memory(bytes, size, error); });
    }
    float directional(float cosine, float alpha) const noexcept
    {
        return vndf_albedo_directional(get(), cosine, alpha);
    }
    vndf_albedo_parts split(float cosine, float alpha) const noexcept
    {
        return vndf_albedo_split(get(), cosine, alpha);
    }
    float average(float alpha, int side = 1) const noexcept { return vndf_albedo_average(get(), alpha, side); }
    vndf_albedo_parts average_split(float alpha, int side = 1) const noexcept
    {
        return vndf_albedo_average_split(get(), alpha, side);
    }
    vndf_albedo_properties info() const noexcept { return vndf_albedo_info(get()); }
    result<void> save(text path) const noexcept
    {
        return detail::status_of([&](vndf_error *error) { return vndf_albedo_save(get(), path.c_str(), error); });
    }
    result<std::vector<std::byte>> save_memory() const noexcept
    {
        const std::size_t size = info().bytes;
        return detail::bytes_of(
            size, [&](void *to, vndf_error *error) { return vndf_albedo_save_memory(get(), to, size, error); });
    }
};

// ---- materials ------------------------------------------------------------------------------------

// A number for each wavelength of a material; 0 beyond.
using spectrum = std::array<float, VNDF_WAVELENGTHS>;

// vndf_description, all zero but for what is set; its members are free to set as well.
class description : public vndf_description
{
  public:
    description() noexcept : vndf_description{} {}
    description(distribution_ref of, float along_x, float along_y) noexcept : description()
    {
        distribution = of.get();
        alpha_x = along_x;
        alpha_y = along_y;
    }
    description(distribution_ref of, float alpha) noexcept : description(of, alpha, alpha) {}
    // Reflects and transmits.
    description &dielectric(float index) noexcept
    {
        effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
        effects.lobes = VNDF_LOBES_BOTH;
        eta = index;
        return *this;
    }
    // A number for each wavelength; their count is that of the material. `resolve` refuses other counts than 1 to
    // VNDF_WAVELENGTHS, and lists of different length.
    description &conductor(std::initializer_list<float> index, std::initializer_list<float> absorption) noexcept
    {
        effects.fresnel = VNDF_FRESNEL_CONDUCTOR;
        copy(index, conductor_eta);
        copy(absorption, conductor_k);
        if (index.size() != absorption.size())
            wavelengths = refused;
        return *this;
    }
    description &schlick(std::initializer_list<float> at_normal_incidence) noexcept
    {
        effects.fresnel = VNDF_FRESNEL_SCHLICK;
        copy(at_normal_incidence, f0);
        return *this;
    }

  private:
    static constexpr int refused = -1;
    void copy(std::initializer_list<float> from, float (&to)[VNDF_WAVELENGTHS]) noexcept
    {
        const bool fits = from.size() >= 1 && from.size() <= VNDF_WAVELENGTHS;
        wavelengths = fits ? static_cast<int>(from.size()) : refused;
        for (std::size_t i = 0; fits && i < from.size(); i++)
            to[i] = from.begin()[i];
    }
};

// A resolved material; one that was not resolved scatters nothing.
class material : public vndf_material
{
  public:
    material() noexcept
    {
        const vndf_description nothing = {};
        vndf_material_resolve(&nothing, this, nullptr);
    }
    static result<material> resolve(const vndf_description &given) noexcept
    {
        material m;
        const auto resolved =
            detail::status_of([&](vndf_error *error) { return vndf_material_resolve(&given, &m, error); });
        if (!resolved)
            return outcome(resolved);
        m.wavelengths_ = given.wavelengths ? static_cast<std::size_t>(given.wavelengths) : 3;
        m.walks_ = given.effects.scattering == VNDF_SCATTERING_MULTIPLE;
        return m;
    }
    std::size_t wavelengths() const noexcept { return wavelengths_; }
    // Whether f is a random number, of which a seed is chosen.
    bool walks() const noexcept { return walks_; }

  private:
    std::size_t wavelengths_ = 3;
    bool walks_ = false;
};

struct evaluated {
    spectrum value;
    float pdf;
};

// A hit. The material must outlive it and stay where it is.
class bsdf : public vndf_bsdf
{
  public:
    // With the roughness, matrix or mixture of the material, or with those of the hit.
    bsdf(const vndf_material &of, vec3 from) noexcept : scatters_(vndf_bsdf_at(this, &of, from) != 0) {}
    bsdf(const vndf_material &of, const vndf_roughness &hit, vec3 from) noexcept
        : scatters_(vndf_bsdf_rough(this, &of, &hit, from) != 0)
    {
    }
    bsdf(const vndf_material &of, const vndf_affine &hit, vec3 from) noexcept
        : scatters_(vndf_bsdf_affine(this, &of, &hit, from) != 0)
    {
    }
    bsdf(const vndf_material &of, const vndf_mixture &hit, vec3 from) noexcept
        : scatters_(vndf_bsdf_mixture(this, &of, &hit, from) != 0)
    {
    }
    bsdf(const vndf_material &&temporary, vec3 from) = delete; // it would be gone
    template <class Hit> bsdf(const vndf_material &&temporary, const Hit &hit, vec3 from) = delete;

    // False: the material scatters nothing from there.
    explicit operator bool() const noexcept { return scatters_; }
    vndf_scattered sample(float u1, float u2, float u3) const noexcept
    {
        const float u[3] = {u1, u2, u3};
        vndf_scattered s;
        vndf_bsdf_sample(this, u, &s);
        return s;
    }
    spectrum eval(vec3 wo, std::uint64_t seed = 0) const noexcept
    {
        spectrum value = {};
        vndf_bsdf_eval(this, wo, seed, value.data());
        return value;
    }
    float pdf(vec3 wo) const noexcept { return vndf_bsdf_pdf(this, wo); }
    evaluated eval_pdf(vec3 wo, std::uint64_t seed = 0) const noexcept
    {
        evaluated both = {};
        vndf_bsdf_eval_pdf(this, wo, seed, both.value.data(), &both.pdf);
        return both;
    }
    // n.wo: what goes with f.
    float cosine_of(vec3 wo) const noexcept { return vndf_bsdf_cosine(this, wo); }

  private:
    bool scatters_;
};

inline float fresnel_dielectric(float cosine, float eta) noexcept
{
    return vndf_fresnel_dielectric(cosine, eta);
}

inline float fresnel_conductor(float cosine, float eta, float k) noexcept
{
    return vndf_fresnel_conductor(cosine, eta, k);
}

inline float fresnel_schlick(float cosine, float f0) noexcept
{
    return vndf_fresnel_schlick(cosine, f0);
}

// ---- spans ----------------------------------------------------------------------------------------

// vndf::span is std::span where there is one. What holds spans has another name for the linker with each of the two,
// so sources of C++17 and of C++20 may be linked together.
#if defined(__cpp_lib_span)
template <class T> using span = std::span<T>;
inline namespace with_std_span
{
#else
inline namespace with_own_span
{
template <class T> class span
{
  public:
    using element_type = T;
    using value_type = std::remove_cv_t<T>;
    using size_type = std::size_t;
    using iterator = T *;

    constexpr span() noexcept = default;
    constexpr span(T *first, std::size_t count) noexcept : data_(first), size_(count) {}
    template <std::size_t N> constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    // Anything with data() and size(): std::vector, std::array, another span.
    template <class Range,
              class = std::enable_if_t<
                  std::is_convertible_v<std::remove_pointer_t<decltype(std::declval<Range &>().data())> (*)[],
                                        T (*)[]> &&
                  std::is_convertible_v<decltype(std::declval<Range &>().size()), std::size_t>>>
    constexpr span(Range &&range) noexcept : data_(range.data()), size_(range.size())
    {
    }
    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T &operator[](std::size_t index) const noexcept { return data_[index]; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr span subspan(std::size_t offset, std::size_t count) const noexcept
    {
        return span(data_ + offset, count);
    }

  private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};
#endif

template <class T, class Range> inline constexpr bool spans = std::is_convertible_v<const Range &, span<const T>>;

// Arrays of directions or normals that are read: x, y and z, of one length.
struct directions {
    span<const float> x, y, z;
};

// Arrays of normals or directions that are written.
struct normals {
    span<float> x, y, z;
    operator directions() const noexcept { return {x, y, z}; }
};

// An argument of a batch: one number for all elements, an array with a number for each, or nothing.
class field
{
  public:
    field() noexcept = default;
    field(float one) noexcept : one_(one), kind_(is_one) {}
    template <class Range, class = std::enable_if_t<spans<float, Range>>>
    field(const Range &many) noexcept : many_(many), kind_(is_many)
    {
    }
    bool none() const noexcept { return kind_ == is_none; }
    bool one() const noexcept { return kind_ == is_one; }
    bool many() const noexcept { return kind_ == is_many; }
    // Of one number it is a member of this object.
    const float *data() const noexcept { return none() ? nullptr : one() ? &one_ : many_.data(); }
    std::size_t size() const noexcept { return many() ? many_.size() : one() ? 1 : 0; }

  private:
    enum kind { is_none, is_one, is_many };
    span<const float> many_;
    float one_ = 0;
    kind kind_ = is_none;
};

// The known directions of a batch: one for all elements, or arrays.
class incident
{
  public:
    incident(vec3 one) noexcept : x(one.x), y(one.y), z(one.z) {}
    incident(directions many) noexcept : x(many.x), y(many.y), z(many.z) {}
    incident(normals many) noexcept : incident(directions(many)) {}
    field x, y, z;
};

namespace detail
{

// Fields that C can share only together.
struct group {
    const char *name;
    bool one = false, many = false;
    unsigned bit_if_one(unsigned bit) const noexcept { return one ? bit : 0; }
};

// Compares the sizes of all arrays of a call with the first one, and keeps the first complaint.
class sizes
{
  public:
    std::size_t count() const noexcept { return count_; }
    sizes &need(const char *name, std::size_t size) noexcept
    {
        if (!first_) {
            first_ = name;
            count_ = size;
        } else if (good_ && size != count_) {
            good_ = false;
            error_.status = VNDF_ERROR_ARGUMENT;
            std::snprintf(error_.message, sizeof error_.message, "%s has %zu elements, %s has %zu", name, size,
                          first_, count_);
        }
        return *this;
    }
    sizes &need(const char *name, const directions &arrays) noexcept
    {
        return need(name, arrays.x.size()).need(name, arrays.y.size()).need(name, arrays.z.size());
    }
    // What may be absent, which is to be empty.
    sizes &may(const char *name, std::size_t size) noexcept { return size ? need(name, size) : *this; }
    sizes &may(const char *name, const directions &arrays) noexcept
    {
        const bool none = arrays.x.empty() && arrays.y.empty() && arrays.z.empty();
        return none ? *this : need(name, arrays);
    }
    sizes &may(group &of, const field &given) noexcept
    {
        of.one = of.one || given.one();
        of.many = of.many || given.many();
        if (of.one && of.many)
            refuse(of.name, "are numbers as well as arrays; one or the other is possible");
        return given.many() ? need(of.name, given.size()) : *this;
    }
    sizes &need(group &of, const field &given) noexcept
    {
        if (given.none())
            refuse(of.name, "are not given");
        return may(of, given);
    }
    sizes &need(group &of, const incident &wi) noexcept { return need(of, wi.x).need(of, wi.y).need(of, wi.z); }
    void refuse(const char *name, const char *what) noexcept
    {
        if (!good_)
            return;
        good_ = false;
        error_.status = VNDF_ERROR_ARGUMENT;
        std::snprintf(error_.message, sizeof error_.message, "%s %s", name, what);
    }
    template <class Call> result<void> run(const Call &call) const noexcept
    {
        if (!good_)
            return outcome(error_, nullptr);
        call();
        return {};
    }

  private:
    vndf_error error_ = {};
    const char *first_ = nullptr;
    std::size_t count_ = 0;
    bool good_ = true;
};

// As C takes arrays; those that are read are not written.
inline vndf_normals to_c(const normals &arrays) noexcept
{
    return {arrays.x.data(), arrays.y.data(), arrays.z.data()};
}

inline vndf_normals to_c(const directions &arrays) noexcept
{
    return {const_cast<float *>(arrays.x.data()), const_cast<float *>(arrays.y.data()),
            const_cast<float *>(arrays.z.data())};
}

template <class T> T *or_null(const span<T> &array) noexcept
{
    return array.empty() ? nullptr : array.data();
}

struct surface_calls {
    using batch = vndf_batch;
    static void pdf(const batch &c, vndf_normals wm, float *to) { vndf_pdf_n(&c, wm, to); }
    static void visible(const batch &c, vndf_normals wm, float *to) { vndf_visible_n(&c, wm, to); }
    static void ndf(const batch &c, vndf_normals wm, float *to) { vndf_ndf_n(&c, wm, to); }
    static void projected_area(const batch &c, float *to) { vndf_projected_area_n(&c, to); }
    static void lambda(const batch &c, float *to) { vndf_lambda_n(&c, to); }
    static void g1(const batch &c, float *to) { vndf_g1_n(&c, to); }
};

struct affine_calls {
    using batch = vndf_affine_batch;
    static void pdf(const batch &c, vndf_normals wm, float *to) { vndf_affine_pdf_n(&c, wm, to); }
    static void visible(const batch &c, vndf_normals wm, float *to) { vndf_affine_visible_n(&c, wm, to); }
    static void ndf(const batch &c, vndf_normals wm, float *to) { vndf_affine_ndf_n(&c, wm, to); }
    static void projected_area(const batch &c, float *to) { vndf_affine_projected_area_n(&c, to); }
    static void lambda(const batch &c, float *to) { vndf_affine_lambda_n(&c, to); }
    static void g1(const batch &c, float *to) { vndf_affine_g1_n(&c, to); }
};

struct mixture_calls {
    using batch = vndf_mixture_batch;
    static void pdf(const batch &c, vndf_normals wm, float *to) { vndf_mixture_pdf_n(&c, wm, to); }
    static void visible(const batch &c, vndf_normals wm, float *to) { vndf_mixture_visible_n(&c, wm, to); }
    static void ndf(const batch &c, vndf_normals wm, float *to) { vndf_mixture_ndf_n(&c, wm, to); }
    static void projected_area(const batch &c, float *to) { vndf_mixture_projected_area_n(&c, to); }
    static void lambda(const batch &c, float *to) { vndf_mixture_lambda_n(&c, to); }
    static void g1(const batch &c, float *to) { vndf_mixture_g1_n(&c, to); }
};

// What the batches of normals have in common. Self::give(c, n) fills in the surfaces, counts their arrays, and returns
// which of them are shared.
template <class Self, class Calls> class normal_batch
{
  public:
    Self &limit(vndf_instructions set) noexcept
    {
        limit_ = set;
        return static_cast<Self &>(*this);
    }
    result<void> pdf(directions wm, span<float> pdf) const noexcept { return of("pdf", wm, pdf, Calls::pdf); }
    result<void> visible(directions wm, span<float> visible) const noexcept
    {
        return of("visible", wm, visible, Calls::visible);
    }
    result<void> ndf(directions wm, span<float> ndf) const noexcept { return of("ndf", wm, ndf, Calls::ndf); }
    result<void> projected_area(span<float> area) const noexcept
    {
        return of("area", area, Calls::projected_area);
    }
    result<void> lambda(span<float> lambda) const noexcept { return of("lambda", lambda, Calls::lambda); }
    result<void> g1(span<float> g1) const noexcept { return of("g1", g1, Calls::g1); }

  protected:
    explicit normal_batch(incident from) noexcept : wi_(from) {}
    template <class Call> result<void> run(sizes &n, const Call &call) const noexcept
    {
        group wi = {"wi"};
        typename Calls::batch c = {};
        n.need(wi, wi_);
        c.shared = static_cast<const Self *>(this)->give(c, n) | wi.bit_if_one(VNDF_SHARED_WI);
        c.count = n.count();
        c.limit = limit_;
        c.wi_x = wi_.x.data();
        c.wi_y = wi_.y.data();
        c.wi_z = wi_.z.data();
        return n.run([&] { call(c); });
    }

  private:
    using batch = typename Calls::batch;
    result<void> of(const char *name, directions wm, span<float> to,
                    void (*call)(const batch &, vndf_normals, float *)) const noexcept
    {
        sizes n;
        n.need(name, to.size()).need("wm", wm);
        return run(n, [&](const batch &c) { call(c, to_c(wm), to.data()); });
    }
    result<void> of(const char *name, span<float> to, void (*call)(const batch &, float *)) const noexcept
    {
        sizes n;
        n.need(name, to.size());
        return run(n, [&](const batch &c) { call(c, to.data()); });
    }
    incident wi_;
    vndf_instructions limit_ = VNDF_INSTRUCTIONS_BEST;
};

} // namespace detail

// ---- many at once ---------------------------------------------------------------------------------

// The set that a batch runs on if it may go up to `limit`.
inline vndf_instructions instructions_used(vndf_instructions limit = VNDF_INSTRUCTIONS_BEST) noexcept
{
    return vndf_instructions_used(limit);
}

// Surfaces and incident directions. Roughness is two numbers for all elements, or two arrays; wi is one direction, or
// arrays. All arrays of a call have one length, that of its other arguments; a call with other lengths does nothing and
// says which. Arrays that are kept by the batch belong to the caller. Results that are optional may be left out.
class batch : public detail::normal_batch<batch, detail::surface_calls>
{
  public:
    batch(distribution_ref of, field along_x, field along_y, incident from) noexcept
        : normal_batch(from), of_(of), alpha_x_(along_x), alpha_y_(along_y)
    {
    }
    batch(distribution_ref of, field alpha, incident from) noexcept : batch(of, alpha, alpha, from) {}
    result<void> sample(span<const float> u1, span<const float> u2, normals wm,
                        span<float> pdf = {}) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm).may("pdf", pdf.size());
        return run(n, [&](const vndf_batch &c) {
            vndf_sample_n(&c, u1.data(), u2.data(), detail::to_c(wm), detail::or_null(pdf));
        });
    }
    result<void> sample_weight(span<const float> u1, span<const float> u2, normals wm, span<float> pdf,
                               span<float> weight) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm).may("pdf", pdf.size());
        n.need("weight", weight.size());
        return run(n, [&](const vndf_batch &c) {
            vndf_sample_weight_n(&c, u1.data(), u2.data(), detail::to_c(wm), detail::or_null(pdf), weight.data());
        });
    }
    result<void> invert(directions wm, span<float> u1, span<float> u2) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm);
        return run(n, [&](const vndf_batch &c) { vndf_invert_n(&c, detail::to_c(wm), u1.data(), u2.data()); });
    }

  private:
    friend class detail::normal_batch<batch, detail::surface_calls>;
    unsigned give(vndf_batch &c, detail::sizes &n) const noexcept
    {
        detail::group alpha = {"alpha_x and alpha_y"};
        n.need(alpha, alpha_x_).need(alpha, alpha_y_);
        c.distribution = of_.get();
        c.alpha_x = alpha_x_.data();
        c.alpha_y = alpha_y_.data();
        return alpha.bit_if_one(VNDF_SHARED_ALPHA);
    }
    distribution_ref of_;
    field alpha_x_, alpha_y_;
};

// Matrices and mean slopes of a batch: xx and yy are needed, the others may be left out, for 0. Those of a batch are
// all numbers or all arrays.
struct matrices {
    field xx, xy, yx, yy;
};

struct slopes {
    field x, y;
};

namespace detail
{
// What affine surfaces and lobes of mixtures have in common.
struct affine_fields {
    distribution_ref of;
    matrices m;
    slopes mean;

    template <class C> void give(C &c, sizes &n, group &shape) const noexcept
    {
        n.need(shape, m.xx).need(shape, m.yy).may(shape, m.xy).may(shape, m.yx);
        n.may(shape, mean.x).may(shape, mean.y);
        c.distribution = of.get();
        c.xx = m.xx.data();
        c.xy = m.xy.data();
        c.yx = m.yx.data();
        c.yy = m.yy.data();
        c.mean_x = mean.x.data();
        c.mean_y = mean.y.data();
    }
};
} // namespace detail

// The same of affine surfaces.
class affine_batch : public detail::normal_batch<affine_batch, detail::affine_calls>
{
  public:
    affine_batch(distribution_ref of, matrices m, incident from, slopes mean = {}) noexcept
        : normal_batch(from), fields_{of, m, mean}
    {
    }
    result<void> sample(span<const float> u1, span<const float> u2, normals wm,
                        span<float> pdf = {}) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm).may("pdf", pdf.size());
        return run(n, [&](const vndf_affine_batch &c) {
            vndf_affine_sample_n(&c, u1.data(), u2.data(), detail::to_c(wm), detail::or_null(pdf));
        });
    }
    result<void> invert(directions wm, span<float> u1, span<float> u2) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm);
        return run(n, [&](const vndf_affine_batch &c) {
            vndf_affine_invert_n(&c, detail::to_c(wm), u1.data(), u2.data());
        });
    }

  private:
    friend class detail::normal_batch<affine_batch, detail::affine_calls>;
    unsigned give(vndf_affine_batch &c, detail::sizes &n) const noexcept
    {
        detail::group shape = {"matrix and mean slope"};
        fields_.give(c, n, shape);
        return shape.bit_if_one(VNDF_SHARED_ALPHA);
    }
    detail::affine_fields fields_;
};

// The same of mixtures, which begin without lobes. The matrices and mean slopes of all lobes are all numbers or all
// arrays, and so are all weights.
class mixture_batch : public detail::normal_batch<mixture_batch, detail::mixture_calls>
{
  public:
    explicit mixture_batch(incident from) noexcept : normal_batch(from) {}
    // One lobe more; more than VNDF_MIXTURE_LOBES are refused by the calls.
    mixture_batch &add(distribution_ref of, matrices m, field weight, slopes mean = {}) noexcept
    {
        if (lobes_ < VNDF_MIXTURE_LOBES) {
            fields_[lobes_] = {of, m, mean};
            weight_[lobes_] = weight;
        }
        lobes_++;
        return *this;
    }
    result<void> sample(span<const float> u1, span<const float> u2, normals wm, span<float> pdf = {},
                        span<int> lobe = {}) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm);
        n.may("pdf", pdf.size()).may("lobe", lobe.size());
        return run(n, [&](const vndf_mixture_batch &c) {
            vndf_mixture_sample_n(&c, u1.data(), u2.data(), detail::to_c(wm), detail::or_null(pdf),
                                  detail::or_null(lobe));
        });
    }
    // `asked` empty: the lobe that draws the normal most often.
    result<void> invert(directions wm, span<const int> asked, span<float> u1, span<float> u2,
                        span<int> lobe = {}) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("wm", wm);
        n.may("asked", asked.size()).may("lobe", lobe.size());
        return run(n, [&](const vndf_mixture_batch &c) {
            vndf_mixture_invert_n(&c, detail::to_c(wm), detail::or_null(asked), u1.data(), u2.data(),
                                  detail::or_null(lobe));
        });
    }

  private:
    friend class detail::normal_batch<mixture_batch, detail::mixture_calls>;
    unsigned give(vndf_mixture_batch &c, detail::sizes &n) const noexcept
    {
        detail::group shape = {"matrices and mean slopes"}, weights = {"weights"};
        if (lobes_ < 1 || lobes_ > VNDF_MIXTURE_LOBES)
            n.refuse("lobes", "are 1 to VNDF_MIXTURE_LOBES");
        for (std::size_t i = 0; i < lobes_ && i < VNDF_MIXTURE_LOBES; i++) {
            fields_[i].give(c.lobe[i], n, shape);
            n.need(weights, weight_[i]);
            c.lobe[i].weight = weight_[i].data();
        }
        c.lobes = static_cast<int>(lobes_);
        return shape.bit_if_one(VNDF_SHARED_ALPHA) | weights.bit_if_one(VNDF_SHARED_WEIGHT);
    }
    std::array<detail::affine_fields, VNDF_MIXTURE_LOBES> fields_ = {};
    std::array<field, VNDF_MIXTURE_LOBES> weight_ = {};
    std::size_t lobes_ = 0;
};

// ---- many hits ------------------------------------------------------------------------------------

// An array for each wavelength of a material; those beyond are not looked at.
using arrays = std::array<span<float>, VNDF_WAVELENGTHS>;

// Results of sampling; wm may be left out.
struct scattered {
    normals wo;
    arrays weight;
    span<float> density;
    span<std::uint8_t> lobe; // vndf_lobe
    normals wm = {};
};

// Hits of one material, which must outlive the batch. What a hit does not bring is that of the material: give the
// calls for its shape. Of these either all fields are numbers, or all are arrays.
class bsdf_batch
{
  public:
    bsdf_batch(const material &of, incident from) noexcept : of_(&of), wi_(from) {}
    bsdf_batch(const material &&temporary, incident from) = delete; // it would be gone
    bsdf_batch &rough(field along_x, field along_y) noexcept
    {
        alpha_x_ = along_x;
        alpha_y_ = along_y;
        return *this;
    }
    bsdf_batch &rotated(field cosine, field sine) noexcept
    {
        cosine_ = cosine;
        sine_ = sine;
        return *this;
    }
    // One for each hit, or one for all.
    bsdf_batch &affine(span<const vndf_affine> each) noexcept
    {
        affine_ = each;
        return *this;
    }
    bsdf_batch &affine(const vndf_affine &one) noexcept { return affine(span<const vndf_affine>(&one, 1)); }
    bsdf_batch &mixture(span<const vndf_mixture> each) noexcept
    {
        mixture_ = each;
        return *this;
    }
    bsdf_batch &mixture(const vndf_mixture &one) noexcept { return mixture(span<const vndf_mixture>(&one, 1)); }
    bsdf_batch &limit(vndf_instructions set) noexcept
    {
        limit_ = set;
        return *this;
    }
    result<void> sample(span<const float> u1, span<const float> u2, span<const float> u3,
                        const scattered &to) const noexcept
    {
        detail::sizes n;
        n.need("u1", u1.size()).need("u2", u2.size()).need("u3", u3.size());
        n.need("wo", to.wo).need("density", to.density.size()).need("lobe", to.lobe.size()).may("wm", to.wm);
        const auto weight = each_wavelength("weight", to.weight, n);
        return run(n, [&](const vndf_bsdf_batch &c) {
            const float *const u[3] = {u1.data(), u2.data(), u3.data()};
            vndf_scattered_n s = {};
            s.wo = detail::to_c(to.wo);
            for (std::size_t i = 0; i < weight.size(); i++)
                s.weight[i] = weight[i];
            s.density = to.density.data();
            s.lobe = to.lobe.data();
            s.wm = {detail::or_null(to.wm.x), detail::or_null(to.wm.y), detail::or_null(to.wm.z)};
            vndf_bsdf_sample_n(&c, u, s);
        });
    }
    // `seed` may be empty unless the material walks.
    result<void> eval(directions wo, span<const std::uint64_t> seed, const arrays &value) const noexcept
    {
        detail::sizes n;
        const auto values = ready(n, wo, seed, value);
        return run(n, [&](const vndf_bsdf_batch &c) {
            vndf_bsdf_eval_n(&c, detail::to_c(wo), detail::or_null(seed), values.data());
        });
    }
    result<void> pdf(directions wo, span<float> pdf) const noexcept
    {
        detail::sizes n;
        n.need("pdf", pdf.size()).need("wo", wo);
        return run(n, [&](const vndf_bsdf_batch &c) { vndf_bsdf_pdf_n(&c, detail::to_c(wo), pdf.data()); });
    }
    result<void> eval_pdf(directions wo, span<const std::uint64_t> seed, const arrays &value,
                          span<float> pdf) const noexcept
    {
        detail::sizes n;
        n.need("pdf", pdf.size());
        const auto values = ready(n, wo, seed, value);
        return run(n, [&](const vndf_bsdf_batch &c) {
            vndf_bsdf_eval_pdf_n(&c, detail::to_c(wo), detail::or_null(seed), values.data(), pdf.data());
        });
    }

  private:
    using pointers = std::array<float *, VNDF_WAVELENGTHS>;

    pointers each_wavelength(const char *name, const arrays &given, detail::sizes &n) const noexcept
    {
        pointers all = {};
        for (std::size_t i = 0; i < of_->wavelengths(); i++) {
            n.need(name, given[i].size());
            all[i] = given[i].data();
        }
        return all;
    }
    pointers ready(detail::sizes &n, const directions &wo, span<const std::uint64_t> seed,
                   const arrays &value) const noexcept
    {
        n.need("wo", wo).may("seed", seed.size());
        if (of_->walks() && seed.empty() && n.count() > 0)
            n.refuse("seed", "is needed for random walks");
        return each_wavelength("value", value, n);
    }
    // One for all, unless that is what there is for each.
    template <class T> void shape_of(detail::sizes &n, detail::group &shape, span<const T> each) const noexcept
    {
        if (each.size() == 1 && n.count() != 1)
            n.may(shape, field(0.0f));
        else if (!each.empty()) {
            n.need(shape.name, each.size());
            shape.many = true;
        }
    }
    template <class Call> result<void> run(detail::sizes &n, const Call &call) const noexcept
    {
        detail::group shape = {"roughness, matrix and mixture"}, wi = {"wi"};
        n.need(wi, wi_);
        n.may(shape, alpha_x_).may(shape, alpha_y_).may(shape, cosine_).may(shape, sine_);
        if (alpha_x_.none() != alpha_y_.none() || cosine_.none() != sine_.none())
            n.refuse(shape.name, "are half given: alpha_x goes with alpha_y, the cosine with the sine");
        shape_of(n, shape, affine_);
        shape_of(n, shape, mixture_);
        vndf_bsdf_batch c = {};
        c.material = of_;
        c.count = n.count();
        c.shared = shape.bit_if_one(VNDF_SHARED_ALPHA) | wi.bit_if_one(VNDF_SHARED_WI);
        c.limit = limit_;
        c.alpha_x = alpha_x_.data();
        c.alpha_y = alpha_y_.data();
        c.cos_rotation = cosine_.data();
        c.sin_rotation = sine_.data();
        c.affine = detail::or_null(affine_);
        c.mixture = detail::or_null(mixture_);
        c.wi_x = wi_.x.data();
        c.wi_y = wi_.y.data();
        c.wi_z = wi_.z.data();
        return n.run([&] { call(c); });
    }
    const material *of_;
    incident wi_;
    field alpha_x_, alpha_y_, cosine_, sine_;
    span<const vndf_affine> affine_;
    span<const vndf_mixture> mixture_;
    vndf_instructions limit_ = VNDF_INSTRUCTIONS_BEST;
};

} // inline namespace with_std_span or with_own_span
} // namespace vndf

#endif
