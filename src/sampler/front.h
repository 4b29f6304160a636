/* The front half circle, cos a >= 0, above the horizon: c F0 + s F1 cos a needs no table of D. Two constant
 * rows of azimuth cells on nodes q = tan(a/2) at even angles from 0 to 90 degrees: the integrals of 1 and of
 * cos a over azimuth up to a node (a and sin a) and over the cell behind it, and the densities in q there,
 * 2/(1+q^2) and 2 (1-q^2)/(1+q^2)^2. */
#ifndef VNDF_SAMPLER_FRONT_H
#define VNDF_SAMPLER_FRONT_H

enum { VNDF_FRONT_CELLS = 16 };

static const float VNDF_QUARTER_TURN = 1.57079633f; /* integral of 1 over the front; that of cos a is 1 */

static const float vndf_front_q[VNDF_FRONT_CELLS + 1] = {
    0.0f, 0.0491268486f, 0.0984914005f, 0.148335993f, 0.198912367f, 0.25048697f,
    0.303346694f, 0.357805729f, 0.414213568f, 0.472964764f, 0.534511149f, 0.599376917f,
    0.668178618f, 0.741650522f, 0.820678771f, 0.906347156f, 1.0f};

static const float vndf_front_even_cdf[VNDF_FRONT_CELLS] = {
    0.0f, 0.098174768f, 0.196349535f, 0.294524323f, 0.392699081f, 0.49087387f,
    0.589048641f, 0.687223406f, 0.785398173f, 0.883572914f, 0.981747724f, 1.07992245f,
    1.17809722f, 1.27627198f, 1.37444676f, 1.47262154f};

static const float vndf_front_even_mass[VNDF_FRONT_CELLS] = {
    0.098174768f, 0.0981747671f, 0.0981747874f, 0.0981747589f, 0.0981747891f, 0.0981747702f,
    0.0981747657f, 0.0981747665f, 0.0981747408f, 0.0981748106f, 0.0981747255f, 0.0981747675f,
    0.0981747664f, 0.0981747778f, 0.0981747799f, 0.0981747852f};

static const float vndf_front_even_density[VNDF_FRONT_CELLS + 1] = {
    2.0f, 1.99518473f, 1.98078528f, 1.95694033f, 1.92387953f, 1.88192126f,
    1.8314696f, 1.77301044f, 1.70710677f, 1.6343933f, 1.55557022f, 1.47139676f,
    1.38268346f, 1.29028471f, 1.19509035f, 1.09801716f, 1.0f};

static const float vndf_front_cosine_cdf[VNDF_FRONT_CELLS] = {
    0.0f, 0.098017138f, 0.195090316f, 0.290284688f, 0.382683432f, 0.471396753f,
    0.555570248f, 0.634393295f, 0.707106788f, 0.773010441f, 0.831469624f, 0.881921253f,
    0.923879522f, 0.956940327f, 0.980785276f, 0.995184725f};

static const float vndf_front_cosine_mass[VNDF_FRONT_CELLS] = {
    0.098017138f, 0.0970731785f, 0.0951943716f, 0.0923987441f, 0.0887133209f, 0.0841734951f,
    0.0788230465f, 0.0727134934f, 0.0659036527f, 0.0584591829f, 0.0504516292f, 0.0419582692f,
    0.0330608046f, 0.0238449491f, 0.0143994496f, 0.00481527478f};

static const float vndf_front_cosine_density[VNDF_FRONT_CELLS + 1] = {
    2.0f, 1.98557737f, 1.94272505f, 1.87267513f, 1.77743292f, 1.65970636f,
    1.5228113f, 1.37055559f, 1.20710676f, 1.03684816f, 0.864228481f, 0.693611663f,
    0.529130087f, 0.374549919f, 0.233150589f, 0.107624518f, 0.0f};

#endif
