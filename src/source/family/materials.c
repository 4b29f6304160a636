/* Published fits to the distributions of normals of measured materials: facts, with their sources.
 *
 * sgd: M. Bagher, C. Soler, N. Holzschuch, "Accurate fitting of measured reflectances using a Shifted Gamma
 *      micro-facet distribution", Computer Graphics Forum 31(4), 2012: alpha and p of each colour channel.
 * abc: J. Low, J. Kronander, A. Ynnerman, J. Unger, "BRDF models for accurate and efficient rendering of glossy
 *      surfaces", ACM Transactions on Graphics 31(1), 2012: B and C.
 *
 * The materials come from the MERL database; numbers as published. tests/source/test_family.c has their checksum. */
#include <string.h>

#include "source/family/family.h"
#include "core/nearest.h"
#include "source/words.h"
#include "vndf_build.h"

/* clang-format off */
#define SGD(name, r, r_p, g, g_p, b, b_p) \
  {"sgd:" name "/r", {r, r_p}}, {"sgd:" name "/g", {g, g_p}}, {"sgd:" name "/b", {b, b_p}}

const vndf_material_fit vndf_material_fits[VNDF_MATERIAL_FITS] = {
    SGD("alum-bronze", 0.014832, 0.459076, 0.0300126, 0.450056, 0.0490339, 0.529272),
    SGD("alumina-oxide", 0.000159222, 0.377727, 0.000139421, 0.318496, 0.000117714, 0.402598),
    SGD("aluminium", 0.0012241, 0.537669, 0.000926487, 0.474562, 0.000991844, 0.435936),
    SGD("aventurnine", 0.000328039, 0.387167, 0.000856166, 0.504525, 0.00145342, 0.652122),
    SGD("beige-fabric", 0.39455, 0.474725, 0.15975, 0.0144728, 0.110706, 1.70871e-12),
    SGD("black-fabric", 0.132262, 0.189024, 0.128044, 0.18842, 0.127838, 0.188426),
    SGD("black-obsidian", 0.000153649, 0.186234, 0.000148939, 0.227495, 0.000179285, 0.25745),
    SGD("black-oxidized-steel", 0.187621, 0.661367, 0.195704, 0.706913, 0.200503, 0.772267),
    SGD("black-phenolic", 0.00670804, 0.706648, 0.00652009, 0.677776, 0.00656043, 0.673986),
    SGD("black-soft-plastic", 0.0926904, 0.14163, 0.0935964, 0.148703, 0.0949975, 0.143694),
    SGD("blue-acrylic", 0.000174482, 0.373948, 0.000269795, 0.362425, 0.0015211, 0.563636),
    SGD("blue-fabric", 0.248706, 9.23066e-13, 0.249248, 1.66486e-12, 0.18736, 2.27218e-12),
    SGD("blue-metallic-paint2", 0.00149045, 0.624615, 0.00110477, 0.598721, 0.00141008, 0.67116),
    SGD("blue-metallic-paint", 0.155564, 1.01719, 0.139, 1.02602, 0.15088, 1.16153),
    SGD("blue-rubber", 0.218197, 0.815054, 0.2668, 1.00146, 0.478375, 1.24995),
    SGD("brass", 0.0002028, 0.362322, 0.000258468, 0.401593, 0.00096108, 0.776606),
    SGD("cherry-235", 0.0182605, 0.0358348, 0.0277997, 0.163231, 0.0255721, 0.129135),
    SGD("chrome", 0.00013, 0.3, 0.0002, 0.36, 6e-05, 0.26),
    SGD("chrome-steel", 5.51292e-05, 0.207979, 3.13288e-05, 0.152758, 4.51944e-05, 0.325431),
    SGD("colonial-maple-223", 0.0197628, 0.0311867, 0.0279336, 0.112022, 0.0621265, 0.344348),
    SGD("color-changing-paint1", 0.00320129, 0.167301, 0.0023053, 0.100003, 0.0329464, 1.04868),
    SGD("color-changing-paint2", 0.0279961, 0.720154, 0.0267135, 0.717648, 0.0257468, 0.694662),
    SGD("color-changing-paint3", 0.014742, 0.537248, 0.0135513, 0.572188, 0.0108894, 0.457665),
    SGD("dark-blue-paint", 0.130681, 0.238562, 0.112103, 0.17, 0.0629285, 0.0157371),
    SGD("dark-red-paint", 0.67372, 1.38127, 0.0706716, 1.4345e-13, 0.20328, 0.27723),
    SGD("dark-specular-fabric", 0.140344, 0.249059, 0.106541, 0.177611, 0.166715, 0.434167),
    SGD("delrin", 0.176535, 0.762088, 0.344018, 0.823603, 0.208011, 0.85976),
    SGD("fruitwood-241", 0.00824986, 0.160382, 0.0534794, 1.07206, 0.0472951, 0.768335),
    SGD("gold-metallic-paint2", 0.00376608, 0.415684, 0.00871206, 0.368424, 0.000572055, 0.623038),
    SGD("gold-metallic-paint3", 0.00146432, 0.529437, 0.00156513, 0.551234, 0.000977438, 0.504486),
    SGD("gold-metallic-paint", 0.127954, 0.781093, 0.127825, 0.795517, 0.109623, 0.661313),
    SGD("gold-paint", 0.122506, 0.795078, 0.108069, 0.637578, 0.12187, 0.936117),
    SGD("gray-plastic", 0.00758705, 0.557908, 0.00848095, 0.556548, 0.00887135, 0.545887),
    SGD("grease-covered-steel", 0.00019081, 0.164569, 0.000173919, 0.141125, 0.000217638, 0.219421),
    SGD("green-acrylic", 0.000185443, 0.288191, 5.19959e-05, 0.170979, 7.95188e-05, 0.145492),
    SGD("green-fabric", 0.0906425, 0.199121, 0.14646, 0.21946, 0.125546, 0.130311),
    SGD("green-latex", 0.241826, 0.175925, 0.21913, 0.162514, 0.2567, 0.326958),
    SGD("green-metallic-paint2", 0.00131834, 0.436009, 0.00140737, 0.57969, 0.00171711, 0.54703),
    SGD("green-metallic-paint", 0.131402, 1.28366, 0.146271, 0.865104, 0.154061, 0.944013),
    SGD("green-plastic", 0.000302146, 0.373134, 0.00197038, 0.751741, 0.000690284, 0.505735),
    SGD("hematite", 0.000908552, 0.515183, 0.000601576, 0.498157, 0.00184248, 0.73351),
    SGD("ipswich-pine-221", 0.014258, 0.0625943, 0.0178759, 0.113994, 0.0188163, 0.118296),
    SGD("light-brown-fabric", 0.147778, 0.188292, 0.137639, 0.188374, 0.13071, 0.189026),
    SGD("light-red-paint", 0.854048, 1.40232, 0.0627781, 0.101554, 0.205965, 0.73691),
    SGD("maroon-plastic", 0.00160715, 0.684406, 0.00110827, 0.645917, 0.00100127, 0.569111),
    SGD("natural-209", 0.0137282, 0.0491415, 0.0154247, 0.0673163, 0.0233645, 0.149331),
    SGD("neoprene-rubber", 0.143818, 0.770284, 0.207586, 0.774203, 0.0764912, 0.700644),
    SGD("nickel", 0.00556292, 0.171288, 0.00627392, 0.168324, 0.00660563, 0.161023),
    SGD("nylon", 0.0250344, 0.528875, 0.0436802, 0.617086, 0.0421753, 0.620808),
    SGD("orange-paint", 0.818115, 1.44385, 0.064743, 0.0709512, 0.229391, 0.483597),
    SGD("pearl-paint", 0.0724063, 0.194454, 0.0808503, 0.203296, 0.0596139, 0.091958),
    SGD("pickled-oak-260", 0.0105853, 2.31337e-14, 0.0102771, 2.35272e-14, 0.0101188, 1.99762e-14),
    SGD("pink-fabric2", 0.220011, 6.44517e-12, 0.148623, 3.24286e-13, 0.111966, 3.83556e-11),
    SGD("pink-fabric", 0.787023, 1.77629, 0.234345, 4.64947e-15, 0.17346, 0.203846),
    SGD("pink-felt", 0.46679, 0.663613, 0.203504, 1.70267e-13, 0.314933, 0.778919),
    SGD("pink-jasper", 0.00223592, 0.53138, 0.00203213, 0.4995, 0.0013737, 0.436111),
    SGD("pink-plastic", 0.0566727, 0.215149, 0.0369011, 0.0621896, 0.142628, 0.189286),
    SGD("polyethylene", 0.0472725, 2.09548e-13, 0.260465, 0.743064, 0.0719615, 2.27838e-13),
    SGD("polyurethane-foam", 0.154984, 0.188586, 0.142104, 0.188095, 0.139418, 0.188124),
    SGD("pure-rubber", 0.62899, 1.13687, 0.41413, 0.452063, 0.0693873, 0.262952),
    SGD("purple-paint", 0.0339173, 0.703279, 0.00839425, 0.20083, 0.0378011, 0.797376),
    SGD("pvc", 0.0171547, 0.769726, 0.0176681, 0.730637, 0.0213663, 0.797555),
    SGD("red-fabric2", 0.16689, 0.184631, 0.135884, 0.18856, 0.128307, 0.1883),
    SGD("red-fabric", 0.324447, 0.787411, 0.228455, 0.821197, 0.109436, 0.279212),
    SGD("red-metallic-paint", 0.00133258, 0.693854, 0.00106883, 0.52857, 0.00128863, 0.539477),
    SGD("red-phenolic", 0.0052844, 0.568938, 0.00467439, 0.509763, 0.00613717, 0.575762),
    SGD("red-plastic", 0.28723, 0.939617, 0.0572489, 0.0851973, 0.0624682, 0.0701483),
    SGD("red-specular-plastic", 6.01746e-05, 0.174569, 8.07327e-05, 0.202455, 0.000205705, 0.390522),
    SGD("silicon-nitrade", 6.40406e-05, 0.159422, 0.000138867, 0.283527, 0.00224354, 0.734323),
    SGD("silver-metallic-paint2", 0.029859, 0.144097, 0.0303706, 0.104489, 0.0358666, 0.158163),
    SGD("silver-metallic-paint", 0.037822, 0.165579, 0.038145, 0.162955, 0.0381908, 0.160835),
    SGD("silver-paint", 0.110819, 0.640378, 0.105318, 0.641115, 0.0785677, 0.445228),
    SGD("special-walnut-224", 0.117091, 0.548899, 0.119932, 0.524858, 0.131119, 0.569425),
    SGD("specular-black-phenolic", 0.00119167, 0.616914, 0.000641898, 0.578026, 0.000186605, 0.40121),
    SGD("specular-blue-phenolic", 0.000918571, 0.570978, 0.0010348, 0.639916, 0.00176322, 0.709385),
    SGD("specular-green-phenolic", 0.000307494, 0.365481, 0.0010353, 0.585805, 0.00155331, 0.787512),
    SGD("specular-maroon-phenolic", 0.000342958, 0.4052, 0.000605578, 0.553617, 0.00144136, 0.65133),
    SGD("specular-orange-phenolic", 7.91913e-05, 0.253564, 0.000139576, 0.354675, 1.62017e-05, 3.55583e-12),
    SGD("specular-red-phenolic", 0.00117843, 0.570146, 0.00056476, 0.524406, 0.00185124, 0.732785),
    SGD("specular-violet-phenolic", 0.00123271, 0.657484, 0.000443974, 0.546753, 0.00149517, 0.653065),
    SGD("specular-white-phenolic", 2.00918e-05, 4.35028e-11, 3.22307e-05, 0.131903, 9.59333e-05, 0.390338),
    SGD("specular-yellow-phenolic", 0.000200174, 0.355381, 0.00179326, 0.767285, 0.00048094, 0.505029),
    SGD("ss440", 4.06782e-05, 0.0888931, 4.86278e-05, 0.259135, 8.15367e-05, 0.332727),
    SGD("steel", 8.63865e-05, 0.3729, 0.000249576, 0.583679, 5.77865e-05, 0.471406),
    SGD("teflon", 0.678586, 1.2402, 0.662167, 1.14126, 0.577852, 1.44077),
    SGD("tungsten-carbide", 6.6122e-05, 0.255291, 7.65809e-05, 0.270824, 4.80196e-05, 0.26732),
    SGD("two-layer-gold", 0.0263104, 0.355682, 0.0293804, 0.354281, 0.0241265, 0.36415),
    SGD("two-layer-silver", 0.0149977, 0.382631, 0.0201665, 0.35975, 0.0225062, 0.361657),
    SGD("violet-acrylic", 0.0011295, 0.523244, 0.00126481, 0.551606, 0.00186818, 0.478149),
    SGD("violet-rubber", 0.445092, 0.923481, 0.089421, 0.782897, 0.1543, 0.800907),
    SGD("white-acrylic", 0.00233914, 0.570501, 0.00168956, 0.51337, 0.00117717, 0.440543),
    SGD("white-diffuse-bball", 0.689731, 1.23085, 0.601478, 0.956833, 0.209084, 0.800488),
    SGD("white-fabric2", 0.0583526, 9.1836e-12, 0.0520763, 5.41897e-13, 0.063905, 3.47708e-12),
    SGD("white-fabric", 0.479844, 0.669662, 0.196767, 2.22894e-13, 0.162438, 0.194582),
    SGD("white-marble", 0.00430204, 0.681306, 0.00429388, 0.676061, 0.00405907, 0.620701),
    SGD("white-paint", 0.0654126, 0.796927, 0.0841905, 0.7778, 0.538225, 0.888627),
    SGD("yellow-matte-plastic", 0.0237573, 0.558101, 0.0265756, 0.537647, 0.0305873, 0.710679),
    SGD("yellow-paint", 0.650734, 1.21986, 0.190849, 0.0333524, 0.16131, 0.137577),
    SGD("yellow-phenolic", 0.00126171, 0.444222, 0.00197611, 0.512534, 0.00187166, 0.504223),
    SGD("yellow-plastic", 0.280789, 0.920018, 0.146396, 0.0356237, 0.0248514, 7.80502e-12),
    {"abc:alum-bronze", {10482.1338, 0.816737}},
    {"abc:alumina-oxide", {97381.5549, 1.39385}},
    {"abc:aluminium", {218716.598, 1.092006}},
    {"abc:aventurnine", {324913.384, 1.110341}},
    {"abc:beige-fabric", {3442009.47, 0.08321}},
    {"abc:blue-acrylic", {255868.96, 1.084736}},
    {"abc:blue-metallic-paint", {48.57206, 1.70252}},
    {"abc:color-changing-paint1", {2456.16181, 1.388325}},
    {"abc:gold-metallic-paint", {53.738525, 1.51173}},
    {"abc:pink-plastic", {16122.7695, 0.217444}},
    {"abc:purple-paint", {408.684145, 1.776584}},
    {"abc:two-layer-gold", {481560.753, 0.631262}},
};
/* clang-format on */

const vndf_material_fit *vndf_material_fit_find(const char *name, size_t size)
{
    for (size_t i = 0; i < VNDF_MATERIAL_FITS; i++)
        if (vndf_is_word(name, size, vndf_material_fits[i].name))
            return &vndf_material_fits[i];
    return NULL;
}

const char *vndf_family_material(size_t index)
{
    return index < VNDF_MATERIAL_FITS ? vndf_material_fits[index].name : NULL;
}

const char *vndf_materials_near(char out[VNDF_MATERIALS_NEAR], const char *name, size_t size)
{
    enum { SHOWN = 3 };
    size_t distance[SHOWN + 1], nearest[SHOWN + 1], count = 0;
    for (size_t i = 0; i < VNDF_MATERIAL_FITS; i++) {
        size_t here = vndf_word_distance(name, size, vndf_material_fits[i].name), at = count;
        for (; at > 0 && here < distance[at - 1]; at--) {
            distance[at] = distance[at - 1];
            nearest[at] = nearest[at - 1];
        }
        distance[at] = here;
        nearest[at] = i;
        count += count < SHOWN;
    }
    out[0] = '\0';
    for (size_t i = 0; i < SHOWN; i++) {
        strncat(out, i > 0 ? ", " : "", VNDF_MATERIALS_NEAR - 1 - strlen(out));
        strncat(out, vndf_material_fits[nearest[i]].name, VNDF_MATERIALS_NEAR - 1 - strlen(out));
    }
    return out;
}
