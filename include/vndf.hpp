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
//         const vndf_surface metal = vndf_rough(*table, 0.3f, 0.1f);
//         const vndf_view view = vndf_view_from(&metal, {0.6f, 0.0f, 0.8f});
//         float pdf;
//         const vndf_vec3 wm = vndf_sample(&view, 0.25f, 0.5f, &pdf);
//         std::printf("%.3f\n", pdf / vndf_pdf(&view, wm));
//     }
//
// prints 1.000.
//
// Errors. What can fail returns a vndf::result: it converts to true or false, *result is the value, an empty owner
// where it failed, message() says what went wrong, and value() throws a vndf::error. Nothing else throws but
// std::bad_alloc, and the header compiles without exceptions and RTTI. What a callable throws does not cross C: it
// counts as NaN, which no build accepts, and of a progress as a wish to stop.
//
// Owners move and do not copy; C takes an empty one as NULL, and a temporary one does not convert to a pointer, since
// that would dangle. Plain structs hold pointers to what they were made from, which must outlive them, as in C: a
// surface its distribution, a family its distributions, a vndf_bsdf its material.
#ifndef VNDF_HPP
#define VNDF_HPP

#include <cstddef>
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
    result(T value, const vndf_error &error = {VNDF_OK, ""}) : error_(error), value_(std::move(value)) {}
    explicit operator bool() const noexcept { return error_.status == VNDF_OK; }
    vndf_status status() const noexcept { return error_.status; }
    const char *message() const noexcept { return error_.message; }
    T &operator*() &noexcept { return value_; }
    const T &operator*() const &noexcept { return value_; }
    T &&operator*() &&noexcept { return std::move(value_); }
#if VNDF_HPP_EXCEPTIONS
    const T &value() const &
    {
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
    vndf_error error_;
    T value_;
};

// The value of a call that has none.
struct nothing {
};

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
    vndf_error error = {VNDF_OK, ""};
    Owner made(make(arguments..., &error));
    return {std::move(made), error};
}

template <class Call, class... Arguments> result<nothing> done(Call *call, const Arguments &...arguments)
{
    vndf_error error = {VNDF_OK, ""};
    call(arguments..., &error);
    return {nothing(), error};
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

// What call() returns, or `otherwise` if it throws.
template <class R, class Call> R guard(R otherwise, const Call &call) noexcept
{
#if VNDF_HPP_EXCEPTIONS
    try {
        return call();
    } catch (...) {
        return otherwise;
    }
#else
    return static_cast<void>(otherwise), call();
#endif
}

inline double evaluate(double x, void *user) noexcept
{
    const density &called = *static_cast<const density *>(user);
    return guard(std::numeric_limits<double>::quiet_NaN(), [&] { return called(x); });
}

template <class Make> result<source> of_callable(Make *make, density given, const std::string &name)
{
    vndf_error error = {VNDF_OK, ""};
    auto kept = std::make_unique<density>(std::move(given));
    vndf_source *from = make(evaluate, kept.get(), name.c_str(), &error);
    return {source(from, std::move(kept)), error};
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

} // namespace vndf

#endif
