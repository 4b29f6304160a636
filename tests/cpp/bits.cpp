// Every number that vndf.hpp returns, of single calls and of batches, has the bits of the C call that it stands for,
// whether arguments are shared numbers or arrays; arrays of the wrong size are refused, and nothing is written.
#include <cmath>
#include <cstring>
#include <vector>

#include "harness/test.h"
#include "vndf.hpp"

namespace
{

const std::size_t count = 67; // no multiple of a number of lanes

template <class T> bool same(const T &a, const T &b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class T> bool same_arrays(const std::vector<T> &a, const std::vector<T> &b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

std::vector<float> numbers(unsigned long long seed, float low, float high)
{
    unsigned long long state = seed;
    std::vector<float> all(count);
    for (float &each : all)
        each = low + (high - low) * test_uniform(&state);
    return all;
}

struct three {
    std::vector<float> x = std::vector<float>(count), y = x, z = x;
    vndf::normals to()
    {
        return {x, y, z};
    }
    vndf::directions from() const
    {
        return {x, y, z};
    }
    vndf_normals c()
    {
        return {x.data(), y.data(), z.data()};
    }
    vndf_vec3 at(std::size_t i) const
    {
        return {x[i], y[i], z[i]};
    }
};

bool same_threes(const three &a, const three &b)
{
    return same_arrays(a.x, b.x) && same_arrays(a.y, b.y) && same_arrays(a.z, b.z);
}

three directions_of(unsigned long long seed, float lowest)
{
    unsigned long long state = seed;
    three all;
    for (std::size_t i = 0; i < count; i++) {
        const float z = lowest + (1 - lowest) * test_uniform(&state), phi = 6.28f * test_uniform(&state);
        const float across = std::sqrt(1 - z * z);
        all.x[i] = across * std::cos(phi);
        all.y[i] = across * std::sin(phi);
        all.z[i] = z;
    }
    return all;
}

vndf::distribution table()
{
    return *vndf::distribution::load(VNDF_SOURCE_DIR "/tables/hazy.vndf");
}

// ---- single calls ----

void test_surface(vndf::distribution_ref of)
{
    const vndf_surface c = {of.get(), 0.3f, 0.1f};
    const vndf::surface s(of, 0.3f, 0.1f);
    const three wi = directions_of(1, -0.9f);
    for (std::size_t i = 0; i + 1 < count; i++) {
        const vndf_view cv = vndf_view_from(&c, wi.at(i));
        const vndf::view v = s.at(wi.at(i));
        float pdf, weight, u1, u2;
        const vndf_vec3 wm = vndf_sample(&cv, 0.3f, 0.6f, &pdf);
        const auto drawn = v.sample(0.3f, 0.6f);
        TEST(v.valid() && same(drawn.wm, wm) && same(drawn.pdf, pdf));
        const vndf_vec3 again = vndf_sample_weight(&cv, 0.7f, 0.2f, &pdf, &weight);
        const auto weighted = v.sample_weight(0.7f, 0.2f);
        TEST(same(weighted.wm, again) && same(weighted.pdf, pdf) && same(weighted.weight, weight));
        TEST(same(v.pdf(again), vndf_pdf(&cv, again)) && same(v.visible(again), vndf_visible(&cv, again)));
        vndf_invert(&cv, wm, &u1, &u2);
        const auto u = v.invert(wm);
        TEST(same(u.u1, u1) && same(u.u2, u2));
        TEST(same(s.ndf(wm), vndf_ndf(&c, wm)) && same(s.p22(0.2f, 0.1f), vndf_p22(&c, 0.2f, 0.1f)));
        TEST(same(s.projected_area(wi.at(i)), vndf_projected_area(&c, wi.at(i))));
        TEST(same(s.lambda(wi.at(i)), vndf_lambda(&c, wi.at(i))) && same(s.g1(wi.at(i)), vndf_g1(&c, wi.at(i))));
        TEST(same(s.g2(wi.at(i), wi.at(i + 1)), vndf_g2(&c, wi.at(i), wi.at(i + 1), VNDF_G2_HEIGHT_CORRELATED)));
    }
    TEST(same(vndf::surface(of, 0.3f).ndf({0, 0, 1}), vndf::surface(of, 0.3f, 0.3f).ndf({0, 0, 1})));
}

void test_affine(vndf::distribution_ref of)
{
    const vndf_affine c = {of.get(), 0.3f, 0.1f, -0.05f, 0.2f, 0.1f, -0.2f};
    const vndf::affine a(of, {0.3f, 0.1f, -0.05f, 0.2f}, {0.1f, -0.2f});
    const three wi = directions_of(2, -0.9f);
    for (std::size_t i = 0; i + 1 < count; i++) {
        const vndf_affine_view cv = vndf_affine_view_from(&c, wi.at(i));
        const vndf::affine_view v = a.at(wi.at(i));
        float pdf, u1, u2;
        const vndf_vec3 wm = vndf_affine_sample(&cv, 0.3f, 0.6f, &pdf);
        const auto drawn = v.sample(0.3f, 0.6f);
        TEST(v.valid() && same(drawn.wm, wm) && same(drawn.pdf, pdf));
        TEST(same(v.pdf(wm), vndf_affine_pdf(&cv, wm)) && same(v.visible(wm), vndf_affine_visible(&cv, wm)));
        vndf_affine_invert(&cv, wm, &u1, &u2);
        const auto u = v.invert(wm);
        TEST(same(u.u1, u1) && same(u.u2, u2));
        TEST(same(a.ndf(wm), vndf_affine_ndf(&c, wm)) && same(a.p22(0.2f, 0), vndf_affine_p22(&c, 0.2f, 0)));
        TEST(same(a.projected_area(wi.at(i)), vndf_affine_projected_area(&c, wi.at(i))));
        TEST(same(a.lambda(wi.at(i)), vndf_affine_lambda(&c, wi.at(i))));
        TEST(same(a.g1(wi.at(i)), vndf_affine_g1(&c, wi.at(i))));
        TEST(same(a.g2(wi.at(i), wi.at(i + 1), VNDF_G2_SEPARABLE),
                  vndf_affine_g2(&c, wi.at(i), wi.at(i + 1), VNDF_G2_SEPARABLE)));
    }
}

vndf::mixture two_lobes(vndf::distribution_ref of)
{
    vndf::mixture m;
    TEST(m.add(vndf::affine(of, {0.3f, 0.1f, -0.05f, 0.2f}, {0.1f, -0.2f}), 0.7f));
    TEST(m.add(vndf::affine(vndf::ggx(), {0.5f, 0, 0, 0.4f}), 0.3f));
    return m;
}

void test_mixture(vndf::distribution_ref of)
{
    const vndf::mixture m = two_lobes(of);
    vndf_mixture c = {};
    c.count = 2;
    c.lobe[0] = {{of.get(), 0.3f, 0.1f, -0.05f, 0.2f, 0.1f, -0.2f}, 0.7f};
    c.lobe[1] = {{vndf_ggx(), 0.5f, 0, 0, 0.4f, 0, 0}, 0.3f};
    const three wi = directions_of(3, -0.9f);
    for (std::size_t i = 0; i + 1 < count; i++) {
        const vndf_mixture_view cv = vndf_mixture_view_from(&c, wi.at(i));
        const vndf::mixture_view v = m.at(wi.at(i));
        float pdf, u1, u2;
        int lobe;
        const vndf_vec3 wm = vndf_mixture_sample(&cv, 0.8f, 0.6f, &pdf, &lobe);
        const auto drawn = v.sample(0.8f, 0.6f);
        TEST(v.valid() && same(drawn.wm, wm) && same(drawn.pdf, pdf) && drawn.lobe == lobe);
        TEST(same(v.pdf(wm), vndf_mixture_pdf(&cv, wm)) && same(v.visible(wm), vndf_mixture_visible(&cv, wm)));
        lobe = vndf_mixture_invert(&cv, wm, -1, &u1, &u2);
        const auto u = v.invert(wm);
        TEST(same(u.u1, u1) && same(u.u2, u2) && u.lobe == lobe);
        TEST(same(m.ndf(wm), vndf_mixture_ndf(&c, wm)) && same(m.p22(0.2f, 0), vndf_mixture_p22(&c, 0.2f, 0)));
        TEST(same(m.projected_area(wi.at(i)), vndf_mixture_projected_area(&c, wi.at(i))));
        TEST(same(m.lambda(wi.at(i)), vndf_mixture_lambda(&c, wi.at(i))));
        TEST(same(m.g1(wi.at(i)), vndf_mixture_g1(&c, wi.at(i))));
        TEST(same(m.g2(wi.at(i), wi.at(i + 1)),
                  vndf_mixture_g2(&c, wi.at(i), wi.at(i + 1), VNDF_G2_HEIGHT_CORRELATED)));
    }
    vndf::mixture full;
    for (int i = 0; i < VNDF_MIXTURE_LOBES - 1; i++)
        TEST(full.add(vndf::affine(vndf::ggx(), {1, 0, 0, 1})));
    TEST(!full.add(m) && full.count == VNDF_MIXTURE_LOBES - 1);
    vndf::mixture haze;
    TEST(haze.add(m, 0.5f) && haze.count == 2 && haze.lobe[1].weight == 0.15f);
}

// ---- batches of normals ----

// What all three kinds of batches have, against single calls of the view and the surface of element i.
template <class Batch, class Surface>
void test_common(const Batch &batch, const three &normals, const Surface &surface_of, const three &wi)
{
    std::vector<float> pdf(count), visible(count), ndf(count), area(count), lambda(count), g1(count);
    TEST(batch.pdf(normals.from(), pdf) && batch.visible(normals.from(), visible));
    TEST(batch.ndf(normals.from(), ndf) && batch.projected_area(area) && batch.lambda(lambda) && batch.g1(g1));
    for (std::size_t i = 0; i < count; i++) {
        const auto surface = surface_of(i);
        const auto view = surface.at(wi.at(i));
        TEST(same(pdf[i], view.pdf(normals.at(i))) && same(visible[i], view.visible(normals.at(i))));
        TEST(same(ndf[i], surface.ndf(normals.at(i))) && same(g1[i], surface.g1(wi.at(i))));
        TEST(same(area[i], surface.projected_area(wi.at(i))) && same(lambda[i], surface.lambda(wi.at(i))));
    }
}

void test_batch(vndf::distribution_ref of)
{
    const std::vector<float> u1 = numbers(5, 0, 1), u2 = numbers(6, 0, 1), ax = numbers(7, 0.1f, 1),
                             ay(count, 0.3f);
    const three wi = directions_of(4, 0.1f);
    three one_wi;
    for (std::size_t i = 0; i < count; i++)
        one_wi.x[i] = 0.6f, one_wi.y[i] = 0, one_wi.z[i] = 0.8f;
    for (int shared = 0; shared < 4; shared++) {
        const bool same_alpha = shared & 1, same_wi = shared & 2;
        const three &from = same_wi ? one_wi : wi;
        const vndf::incident incident = same_wi ? vndf::incident(vndf::vec3{0.6f, 0, 0.8f}) : wi.from();
        const vndf::batch batch =
            same_alpha ? vndf::batch(of, 0.2f, 0.3f, incident) : vndf::batch(of, ax, ay, incident);
        const auto surface_of = [&](std::size_t i) { return vndf::surface(of, same_alpha ? 0.2f : ax[i], 0.3f); };
        three wm, again;
        std::vector<float> pdf(count), weight(count), v1(count), v2(count);
        TEST(batch.sample(u1, u2, wm.to(), pdf) && batch.sample(u1, u2, again.to()) && same_threes(wm, again));
        for (std::size_t i = 0; i < count; i++) {
            const auto drawn = surface_of(i).at(from.at(i)).sample(u1[i], u2[i]);
            TEST(same(drawn.wm, wm.at(i)) && same(drawn.pdf, pdf[i]));
        }
        TEST(batch.sample_weight(u1, u2, again.to(), pdf, weight) && same_threes(wm, again));
        TEST(batch.invert(wm.from(), v1, v2));
        for (std::size_t i = 0; i < count; i++) {
            const auto view = surface_of(i).at(from.at(i));
            TEST(same(view.sample_weight(u1[i], u2[i]).weight, weight[i]));
            TEST(same(view.invert(wm.at(i)).u1, v1[i]) && same(view.invert(wm.at(i)).u2, v2[i]));
        }
        test_common(batch, wm, surface_of, from);
    }
}

void test_affine_batch(vndf::distribution_ref of)
{
    const std::vector<float> u1 = numbers(5, 0, 1), u2 = numbers(6, 0, 1), xx = numbers(7, 0.1f, 1);
    const std::vector<float> xy = numbers(8, -0.1f, 0.1f), yy(count, 0.3f), mx = numbers(9, -0.2f, 0.2f);
    const three wi = directions_of(4, 0.1f);
    for (int shared = 0; shared < 2; shared++) {
        const auto surface_of = [&](std::size_t i) {
            return shared ? vndf::affine(of, {0.2f, 0.1f, 0, 0.3f}, {0.1f, 0})
                          : vndf::affine(of, {xx[i], xy[i], 0, yy[i]}, {mx[i], 0});
        };
        const vndf::affine_batch batch =
            shared ? vndf::affine_batch(of, {0.2f, 0.1f, {}, 0.3f}, wi.from(), {0.1f, {}})
                   : vndf::affine_batch(of, {xx, xy, {}, yy}, wi.from(), {mx, {}});
        three wm;
        std::vector<float> pdf(count), v1(count), v2(count);
        TEST(batch.sample(u1, u2, wm.to(), pdf) && batch.invert(wm.from(), v1, v2));
        for (std::size_t i = 0; i < count; i++) {
            const auto view = surface_of(i).at(wi.at(i));
            const auto drawn = view.sample(u1[i], u2[i]);
            TEST(same(drawn.wm, wm.at(i)) && same(drawn.pdf, pdf[i]));
            TEST(same(view.invert(wm.at(i)).u1, v1[i]) && same(view.invert(wm.at(i)).u2, v2[i]));
        }
        test_common(batch, wm, surface_of, wi);
    }
}

void test_mixture_batch(vndf::distribution_ref of)
{
    const std::vector<float> u1 = numbers(5, 0, 1), u2 = numbers(6, 0, 1), weight = numbers(7, 0.1f, 1);
    const vndf::mixture fixed = two_lobes(of);
    const three wi = directions_of(4, 0.1f);
    vndf::mixture_batch batch(wi.from());
    batch.add(of, {0.3f, 0.1f, -0.05f, 0.2f}, weight, {0.1f, -0.2f});
    batch.add(vndf::ggx(), {0.5f, 0.0f, 0.0f, 0.4f}, u1).limit(VNDF_INSTRUCTIONS_PORTABLE);
    const auto mixture_of = [&](std::size_t i) {
        vndf::mixture m = fixed;
        m.lobe[0].weight = weight[i];
        m.lobe[1].weight = u1[i];
        return m;
    };
    three wm;
    std::vector<float> pdf(count), v1(count), v2(count);
    std::vector<int> lobe(count), inverted(count);
    TEST(batch.sample(u1, u2, wm.to(), pdf, lobe) && batch.invert(wm.from(), {}, v1, v2, inverted));
    for (std::size_t i = 0; i < count; i++) {
        const auto m = mixture_of(i);
        const auto view = m.at(wi.at(i));
        const auto drawn = view.sample(u1[i], u2[i]);
        const auto u = view.invert(wm.at(i));
        TEST(same(drawn.wm, wm.at(i)) && same(drawn.pdf, pdf[i]) && drawn.lobe == lobe[i]);
        TEST(same(u.u1, v1[i]) && same(u.u2, v2[i]) && u.lobe == inverted[i]);
    }
    test_common(batch, wm, mixture_of, wi);
}

void test_sizes()
{
    const std::vector<float> u(4, 0.5f), short_one(3, 0.5f);
    std::vector<float> x(4, 9.0f), y = x, z = x, pdf(3, 9.0f), empty;
    const vndf::batch batch(vndf::ggx(), 0.3f, vndf::vec3{0, 0, 1});
    const auto refused = [&](const vndf::result<void> &r, const char *says) {
        TEST(!r && r.status() == VNDF_ERROR_ARGUMENT && x[0] == 9.0f && y[0] == 9.0f);
        TEST_HAS(r.message(), says);
    };
    refused(batch.sample(u, short_one, {x, y, z}), "u2 has 3 elements, u1 has 4");
    refused(batch.sample(u, u, {x, y, z}, pdf), "pdf has 3 elements, u1 has 4");
    refused(batch.sample(u, u, {x, empty, z}), "wm has 0 elements, u1 has 4");
    refused(batch.g1({}).status() == VNDF_OK ? batch.pdf({x, y, z}, pdf) : vndf::result<void>(),
            "wm has 4 elements, pdf has 3");
    refused(vndf::batch(vndf::ggx(), short_one, short_one, vndf::vec3{0, 0, 1}).sample(u, u, {x, y, z}),
            "alpha_x and alpha_y has 3 elements, u1 has 4");
    refused(vndf::batch(vndf::ggx(), u, 0.3f, vndf::vec3{0, 0, 1}).sample(u, u, {x, y, z}), "numbers as well");
    refused(vndf::batch(vndf::ggx(), {}, 0.3f, vndf::vec3{0, 0, 1}).sample(u, u, {x, y, z}), "are not given");
    refused(vndf::batch(vndf::ggx(), 0.3f, vndf::directions{u, u, short_one}).sample(u, u, {x, y, z}), "wi has 3");
    refused(vndf::mixture_batch(vndf::vec3{0, 0, 1}).sample(u, u, {x, y, z}), "lobes are 1 to");
    vndf::mixture_batch many(vndf::vec3{0, 0, 1});
    for (int i = 0; i <= VNDF_MIXTURE_LOBES; i++)
        many.add(vndf::ggx(), {0.3f, {}, {}, 0.3f}, 1.0f);
    refused(many.sample(u, u, {x, y, z}), "lobes are 1 to");
    TEST(batch.sample(u, u, {x, y, z}) && x[0] != 9.0f);
}

// ---- materials ----

const vndf::description &glass()
{
    static const auto d = vndf::description(vndf::ggx(), 0.2f).dielectric(1.5f);
    return d;
}

void test_bsdf()
{
    vndf_description c = {};
    vndf_material cm;
    vndf_bsdf cb;
    c.distribution = vndf_ggx();
    c.alpha_x = c.alpha_y = 0.2f;
    c.eta = 1.5f;
    c.effects.lobes = VNDF_LOBES_BOTH;
    c.effects.fresnel = VNDF_FRESNEL_DIELECTRIC;
    TEST(vndf_material_resolve(&c, &cm, nullptr) == VNDF_OK);
    const auto material = vndf::material::resolve(glass());
    const three wi = directions_of(11, -0.9f), wo = directions_of(12, -0.9f);
    const std::vector<float> u1 = numbers(5, 0, 1), u2 = numbers(6, 0, 1), u3 = numbers(7, 0, 1);
    if (!TEST(material && material->wavelengths() == 3 && !material->walks()))
        return;
    for (std::size_t i = 0; i < count; i++) {
        const float u[3] = {u1[i], u2[i], u3[i]};
        vndf_scattered cs;
        float value[3], pdf;
        const vndf::bsdf b(*material, wi.at(i));
        TEST(vndf_bsdf_at(&cb, &cm, wi.at(i)) == 1 && b);
        vndf_bsdf_sample(&cb, u, &cs);
        const vndf_scattered s = b.sample(u[0], u[1], u[2]);
        TEST(same(s.wo, cs.wo) && same(s.wm, cs.wm) && same(s.density, cs.density) && s.lobe == cs.lobe);
        TEST(std::memcmp(s.weight, cs.weight, sizeof value) == 0);
        vndf_bsdf_eval_pdf(&cb, wo.at(i), 0, value, &pdf);
        const auto both = b.eval_pdf(wo.at(i));
        TEST(std::memcmp(both.value.data(), value, sizeof value) == 0 && same(both.pdf, pdf));
        TEST(b.eval(wo.at(i)) == both.value && same(b.pdf(wo.at(i)), pdf));
        TEST(same(b.cosine_of(wo.at(i)), vndf_bsdf_cosine(&cb, wo.at(i))));
    }
    TEST(same(vndf::fresnel_dielectric(0.3f, 1.5f), vndf_fresnel_dielectric(0.3f, 1.5f)));
    TEST(same(vndf::fresnel_conductor(0.3f, 0.2f, 3), vndf_fresnel_conductor(0.3f, 0.2f, 3)));
    TEST(same(vndf::fresnel_schlick(0.3f, 0.04f), vndf_fresnel_schlick(0.3f, 0.04f)));
}

// Of the hit: roughness, matrix, mixture.
void test_hits()
{
    vndf::description d(vndf::ggx(), 0.2f);
    d.schlick({0.9f, 0.6f, 0.3f, 0.2f}).effects.shape = VNDF_SHAPE_ROTATED;
    const vndf::vec3 wi = {0.6f, 0, 0.8f}, wo = {-0.5f, 0.1f, 0.86f};
    const auto rotated = vndf::material::resolve(d);
    const vndf_roughness r = {0.3f, 0.1f, 0.8f, 0.6f};
    const vndf::affine a(vndf::ggx(), {0.3f * 0.8f, -0.1f * 0.6f, 0.3f * 0.6f, 0.1f * 0.8f});
    vndf::mixture m;
    m.add(a);
    d.affine = a;
    d.effects.shape = VNDF_SHAPE_AFFINE;
    const auto affine = vndf::material::resolve(d);
    d.effects.shape = VNDF_SHAPE_MIXTURE;
    const auto mixture = vndf::material::resolve(d);
    if (!TEST(rotated && affine && mixture && rotated->wavelengths() == 4))
        return;
    const vndf::bsdf by_r(*rotated, r, wi), by_a(*affine, a, wi), by_m(*mixture, m, wi);
    TEST(by_r && by_a && by_m && !vndf::bsdf(*mixture, wi) && !vndf::bsdf(*affine, r, wi));
    const float value = by_r.eval(wo)[3];
    TEST(value > 0);
    TEST_RELATIVE((double)by_a.eval(wo)[3], (double)value, 1e-5);
    TEST_RELATIVE((double)by_m.eval(wo)[3], (double)value, 1e-5);
}

void test_bsdf_batch()
{
    const auto material = vndf::material::resolve(glass());
    const three wi = directions_of(11, -0.9f), wo = directions_of(12, -0.9f);
    const std::vector<float> u1 = numbers(5, 0, 1), u2 = numbers(6, 0, 1), u3 = numbers(7, 0, 1);
    const std::vector<float> alpha = numbers(8, 0.1f, 0.9f), few(3);
    three to, wm;
    std::vector<float> r(count), g(count), b(count), density(count), pdf(count), pdf2(count), r2(count);
    std::vector<std::uint8_t> lobe(count);
    vndf::bsdf_batch batch(*material, wi.from());
    batch.rough(alpha, alpha);
    TEST(batch.sample(u1, u2, u3, {to.to(), {r, g, b}, density, lobe, wm.to()}));
    for (std::size_t i = 0; i < count; i++) {
        const vndf::bsdf hit(*material, vndf_roughness{alpha[i], alpha[i], 1, 0}, wi.at(i));
        const auto s = hit.sample(u1[i], u2[i], u3[i]);
        TEST(same(s.wo, to.at(i)) && same(s.density, density[i]) && s.lobe == lobe[i] && same(s.wm, wm.at(i)));
        TEST(same(s.weight[0], r[i]) && same(s.weight[2], b[i]));
    }
    TEST(batch.eval_pdf(wo.from(), {}, {r, g, b}, pdf) && batch.pdf(wo.from(), pdf2) && same_arrays(pdf, pdf2));
    TEST(batch.eval(wo.from(), {}, {r2, g, b}) && same_arrays(r, r2));
    for (std::size_t i = 0; i < count; i++) {
        const vndf::bsdf hit(*material, vndf_roughness{alpha[i], alpha[i], 1, 0}, wi.at(i));
        const auto both = hit.eval_pdf(wo.at(i));
        TEST(same(both.value[0], r[i]) && same(both.value[1], g[i]) && same(both.pdf, pdf[i]));
    }
    TEST(!batch.eval(wo.from(), {}, {r, g}) && !batch.pdf(wo.from(), pdf = few));
    pdf.resize(count);
    TEST(!vndf::bsdf_batch(*material, wi.from()).rough(0.1f, {}).pdf(wo.from(), pdf));
    TEST(!vndf::bsdf_batch(*material, wi.from()).rough(0.1f, alpha).pdf(wo.from(), pdf));
    TEST(!vndf::bsdf_batch(*material, wi.from()).rough(few, few).pdf(wo.from(), pdf));
}

void test_rotated_batch()
{
    vndf::description d(vndf::ggx(), 0.2f);
    d.effects.shape = VNDF_SHAPE_ROTATED;
    const auto material = vndf::material::resolve(d);
    const three wi = directions_of(11, 0.3f), wo = directions_of(12, 0.3f);
    const std::vector<float> ax = numbers(8, 0.1f, 0.9f), cosine(count, 0.8f), sine(count, 0.6f);
    std::vector<float> pdf(count);
    TEST(vndf::bsdf_batch(*material, wi.from()).rough(ax, cosine).rotated(cosine, sine).pdf(wo.from(), pdf));
    for (std::size_t i = 0; i < count; i++) {
        const vndf_roughness hit = {ax[i], 0.8f, 0.8f, 0.6f};
        TEST(same(pdf[i], vndf::bsdf(*material, hit, wi.at(i)).pdf(wo.at(i))) && pdf[i] > 0);
    }
}

// One matrix or mixture for all hits, and one for each.
void test_shapes_of_batch()
{
    vndf::description d(vndf::ggx(), 0.2f);
    d.effects.shape = VNDF_SHAPE_AFFINE;
    d.affine = vndf::affine(nullptr, {0.5f, 0, 0, 0.5f});
    const auto material = vndf::material::resolve(d);
    const three wi = directions_of(11, 0.3f), wo = directions_of(12, 0.3f);
    const vndf::affine a(vndf::ggx(), {0.3f, 0.1f, 0, 0.2f}, {0.1f, 0});
    const std::vector<vndf_affine> each(count, a), few(3, a);
    std::vector<float> one(count), all(count);
    TEST(vndf::bsdf_batch(*material, wi.from()).affine(a).pdf(wo.from(), one));
    TEST(vndf::bsdf_batch(*material, wi.from()).affine(each).pdf(wo.from(), all) && same_arrays(one, all));
    TEST(same(one[7], vndf::bsdf(*material, a, wi.at(7)).pdf(wo.at(7))) && one[7] > 0);
    TEST(!vndf::bsdf_batch(*material, wi.from()).affine(few).pdf(wo.from(), all));
    d.effects.shape = VNDF_SHAPE_MIXTURE;
    const auto mixed = vndf::material::resolve(d);
    const vndf::mixture m = two_lobes(vndf::beckmann());
    const std::vector<vndf_mixture> mixtures(count, m);
    TEST(vndf::bsdf_batch(*mixed, wi.from()).mixture(m).pdf(wo.from(), one));
    TEST(vndf::bsdf_batch(*mixed, wi.from()).mixture(mixtures).pdf(wo.from(), all) && same_arrays(one, all));
    TEST(same(one[7], vndf::bsdf(*mixed, m, wi.at(7)).pdf(wo.at(7))) && one[7] > 0);
}

void test_walks()
{
    vndf::description d(vndf::ggx(), 0.8f);
    d.effects.scattering = VNDF_SCATTERING_MULTIPLE;
    const auto material = vndf::material::resolve(d);
    const three wi = directions_of(11, 0.3f), wo = directions_of(12, 0.3f);
    std::vector<float> r(count), g(count), b(count);
    std::vector<std::uint64_t> seed(count, 5);
    const vndf::bsdf_batch batch(*material, wi.from());
    TEST(material->walks() && !batch.eval(wo.from(), {}, {r, g, b}) && batch.eval(wo.from(), seed, {r, g, b}));
    TEST(same(r[3], vndf::bsdf(*material, wi.at(3)).eval(wo.at(3), 5)[0]));
}

} // namespace

int main()
{
    const vndf::distribution hazy = table();
    TEST(hazy && std::strcmp(vndf::version(), VNDF_VERSION) == 0);
    TEST(vndf::instructions_used(VNDF_INSTRUCTIONS_PORTABLE) == VNDF_INSTRUCTIONS_PORTABLE);
    for (const vndf::distribution_ref of : {vndf::ggx(), vndf::beckmann(), vndf::distribution_ref(hazy)}) {
        test_surface(of);
        test_affine(of);
        test_mixture(of);
        test_batch(of);
        test_affine_batch(of);
        test_mixture_batch(of);
    }
    test_sizes();
    test_bsdf();
    test_hits();
    test_bsdf_batch();
    test_rotated_batch();
    test_shapes_of_batch();
    test_walks();
    return test_done();
}
