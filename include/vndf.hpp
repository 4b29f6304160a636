// vndf.hpp - what C lacks, in C++17: owners that free, errors as results or exceptions, and sources made of callables.
//
// The calls of vndf.h, vndf_bsdf.h and vndf_build.h are C++ calls, and their comments hold: an owner converts to the
// pointer that they take. This header adds neither state nor arithmetic.
//
//     #include <cmath>
//     #include <cstdio>
//     #include <vndf.hpp>
//
//     int main()
//     {
//         const auto law = [k = 3.0](double r) { return std::exp(-k * r) * (1 + 0.8 * std::cos(6 * r)); };
//         const auto source = vndf::slope_callback(law, "wavy");
//         const auto table = vndf::build(*source);
//         if (!table)
//             return std::puts(table.message()), 1;
//         const vndf_surface metal = {*table, 0.3f, 0.1f};
//         const vndf_view view = vndf_view_from(&metal, {0.6f, 0.0f, 0.8f});
//         const auto [wm, pdf] = vndf::sample(view, 0.25f, 0.5f);
//         std::printf("%.3f\n", pdf / vndf_pdf(&view, wm));
//     }
//
// prints 1.000.
//
// Errors. What can fail returns a vndf::result: it converts to true or false, *result is the value, an empty owner
// where it failed, message() says what went wrong, and value() throws a vndf::error. Nothing else throws but
// std::bad_alloc, and the header compiles without exceptions and RTTI. What a callable throws does not cross C: the
// build stops, its result holds the exception, and value() throws it again. Called by a function of C outside this
// header, such a callable gives NaN.
//
// Owners move and do not copy; C takes an empty one as NULL, and a temporary one does not convert to a pointer, since
// that would dangle. Plain structs hold pointers to what they were made from, which must outlive them, as in C: a
// surface its distribution, a family its distributions, a vndf_bsdf its material.
#ifndef VNDF_HPP
#define VNDF_HPP

#include <cstddef>
#include <cstdio>
#include <exception>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "vndf.h"
#include "vndf_bsdf.h"
#include "vndf_build.h"

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#  define VNDF_HPP_EXCEPTIONS 1
#else
#  define VNDF_HPP_EXCEPTIONS 0
#endif

namespace vndf
{

// ---- results --------------------------------------------------------------------------------------

// A failed call as an exception.
class error : public std::runtime_error
{
  public:
    explicit error(const vndf_error &what) : std::runtime_error(what.message), status_(what.status) {}
    vndf_status status() const noexcept { return status_; }

  private:
    vndf_status status_;
};

// A value, or what went wrong and an empty value.
template <class T> class [[nodiscard]] result
{
  public:
    result(T value) : value_(std::move(value)) {}
    result(const vndf_error &error, std::exception_ptr thrown = nullptr) : error_(error), thrown_(thrown) {}
    explicit operator bool() const noexcept { return error_.status == VNDF_OK; }
    vndf_status status() const noexcept { return error_.status; }
    const char *message() const noexcept { return error_.message; }
    std::exception_ptr thrown() const noexcept { return thrown_; } // by a callable meanwhile, or null
    T &operator*() &noexcept { return value_; }
    const T &operator*() const &noexcept { return value_; }
    T &&operator*() &&noexcept { return std::move(value_); }
#if VNDF_HPP_EXCEPTIONS
    const T &value() const &
    {
        if (thrown_)
            std::rethrow_exception(thrown_);
        if (error_.status != VNDF_OK)
            throw error(error_);
        return value_;
    }
    T value() &&
    {
        return static_cast<const result &>(*this).value(), std::move(value_);
    }
#endif

  private:
    vndf_error error_ = {VNDF_OK, ""};
    std::exception_ptr thrown_;
    T value_{};
};

// The value of a call that has none.
struct nothing {
};

namespace detail
{

// Where callables that C calls on this thread leave what they throw: the innermost call of this header.
inline std::exception_ptr *&pending() noexcept
{
    static thread_local std::exception_ptr *innermost = nullptr;
    return innermost;
}

// What call() returns; `otherwise` if it throws, or a callable before it has thrown.
template <class R, class Call> R guard(R otherwise, const Call &call) noexcept
{
    if (pending() && *pending())
        return otherwise;
#if VNDF_HPP_EXCEPTIONS
    try {
        return call();
    } catch (...) {
        if (pending())
            *pending() = std::current_exception();
        return otherwise;
    }
#else
    return call();
#endif
}

// What call(&error) returns, unless it fails or a callable throws meanwhile.
template <class T, class Call> result<T> made(const Call &call)
{
    vndf_error error = {VNDF_OK, ""};
    std::exception_ptr thrown;
    std::exception_ptr *const outer = std::exchange(pending(), &thrown);
    T value(call(&error));
    pending() = outer;
    if (error.status == VNDF_OK && !thrown)
        return result<T>(std::move(value));
#if VNDF_HPP_EXCEPTIONS
    if (thrown) {
        error = {VNDF_ERROR_ARGUMENT, "a callable threw something that is no std::exception"};
        try {
            std::rethrow_exception(thrown);
        } catch (const std::exception &known) {
            std::snprintf(error.message, sizeof error.message, "a callable threw: %s", known.what());
        } catch (...) {
        }
    }
#endif
    return {error, thrown};
}

} // namespace detail

// ---- owners ---------------------------------------------------------------------------------------

// Owns what a call of C returned, and a callable that C calls back.
template <class T, void (*Free)(T *), class Kept = std::nullptr_t> class owner
{
  public:
    owner() noexcept = default;
    explicit owner(T *owned, Kept kept = {}) noexcept : kept_(std::move(kept)), owned_(owned) {}
    explicit operator bool() const noexcept { return owned_ != nullptr; }
    operator const T *() const &noexcept { return owned_.get(); }
    operator const T *() const && = delete; // it would be gone
    T *get() const noexcept { return owned_.get(); }

  private:
    struct freer {
        void operator()(T *owned) const noexcept { Free(owned); }
    };
    Kept kept_ = {};
    std::unique_ptr<T, freer> owned_;
};

using density = std::function<double(double)>;

using distribution = owner<vndf_distribution, vndf_free>;
using family = owner<vndf_family, vndf_family_free>;
using albedo = owner<vndf_albedo, vndf_albedo_free>;
using source = owner<vndf_source, vndf_source_free, std::unique_ptr<density>>;

// What a call of C makes, owned, and how a call that returns a status went. Both take its arguments without the
// error:
//
//     const auto tails = vndf::own<vndf::family>(vndf_family_load, "tails.vndfs");
//     vndf_material material; // must not move while a vndf_bsdf points to it
//     const auto resolved = vndf::done(vndf_material_resolve, &description, &material);
template <class Owner, class Make, class... Arguments> result<Owner> own(Make *make, const Arguments &...arguments)
{
    return detail::made<Owner>([&](vndf_error *error) { return Owner(make(arguments..., error)); });
}

template <class Call, class... Arguments> result<nothing> done(Call *call, const Arguments &...arguments)
{
    return detail::made<nothing>([&](vndf_error *error) { return call(arguments..., error), nothing(); });
}

inline result<distribution> load(const std::string &path)
{
    return own<distribution>(vndf_load, path.c_str());
}

// ---- sources and builds ---------------------------------------------------------------------------

// Formulas, with their parameters: {{"k", 3.0}}.
inline result<source> ndf_expression(const std::string &text, std::initializer_list<vndf_parameter> set = {})
{
    return own<source>(vndf_source_ndf_expression, text.c_str(), set.begin(), set.size());
}

inline result<source> slope_expression(const std::string &text, std::initializer_list<vndf_parameter> set = {})
{
    return own<source>(vndf_source_slope_expression, text.c_str(), set.begin(), set.size());
}

// Told how far a build is, in [0, 1], and its stage. True: go on; false: stop.
using progress = std::function<bool(double done, const char *what)>;

namespace detail
{

inline double evaluate(double x, void *user) noexcept
{
    const density &called = *static_cast<const density *>(user);
    return guard(std::numeric_limits<double>::quiet_NaN(), [&] { return called(x); });
}

template <class Make> result<source> of_callable(Make *make, density given, const std::string &name)
{
    auto kept = std::make_unique<density>(std::move(given));
    return made<source>([&](vndf_error *error) {
        vndf_source *from = make(evaluate, kept.get(), name.c_str(), error);
        return source(from, std::move(kept));
    });
}

// Options that tell `told`, which outlives the build.
template <class Options> Options telling(Options options, const progress &told)
{
    if (told) {
        options.progress = [](double done, const char *what, void *user) {
            return guard(1, [&] { return (*static_cast<const progress *>(user))(done, what) ? 0 : 1; });
        };
        options.progress_user = const_cast<progress *>(&told);
    }
    return options;
}

} // namespace detail

// D(cos theta_m), and P22(r), as anything that is called with a double and returns one. The source keeps it alive.
inline result<source> ndf_callback(density ndf, const std::string &name)
{
    return detail::of_callable(vndf_source_ndf_callback, std::move(ndf), name);
}

inline result<source> slope_callback(density p22, const std::string &name)
{
    return detail::of_callable(vndf_source_slope_callback, std::move(p22), name);
}

inline result<distribution> build(const source &from, const vndf_build_options &options = {},
                                  const progress &told = {})
{
    const vndf_build_options all = detail::telling(options, told);
    return own<distribution>(vndf_build, from.get(), &all, static_cast<vndf_certificate *>(nullptr));
}

inline result<family> build_family(const std::string &specification, double low, double high,
                                   const vndf_family_options &options = {}, const progress &told = {})
{
    const vndf_family_options all = detail::telling(options, told);
    return own<family>(vndf_build_family, specification.c_str(), low, high, &all);
}

// ---- samples --------------------------------------------------------------------------------------

// For structured bindings: auto [wm, pdf] = vndf::sample(view, u1, u2).
struct drawn {
    vndf_vec3 wm;
    float pdf;
};

struct weighted {
    vndf_vec3 wm;
    float pdf, weight;
};

inline drawn sample(const vndf_view &view, float u1, float u2) noexcept
{
    drawn d;
    d.wm = vndf_sample(&view, u1, u2, &d.pdf);
    return d;
}

inline weighted sample_weight(const vndf_view &view, float u1, float u2) noexcept
{
    weighted w;
    w.wm = vndf_sample_weight(&view, u1, u2, &w.pdf, &w.weight);
    return w;
}

} // namespace vndf

#endif
