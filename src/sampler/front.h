/* The front half circle, cos a >= 0, above the horizon: c F0 + s F1 cos a needs no table of D. Two constant
 * rows of azimuth cells on nodes q = tan(a/2), a = 90 degrees w (1.5 - 0.5 w) for w = 0, 1/20, ..., 1, closer
 * towards 90 degrees, where cos a vanishes: the integrals of 1 and of cos a over azimuth up to a node (a and
 * sin a) and over the cell behind it, and the densities in q there, 2/(1+q^2) and 2 (1-q^2)/(1+q^2)^2. The cells
 * miss 1e-6 of the azimuths at normal incidence and 1.2e-5 at grazing (total variation). */
#ifndef VNDF_SAMPLER_FRONT_H
#define VNDF_SAMPLER_FRONT_H

enum { VNDF_FRONT_CELLS = 20 };

static const float VNDF_QUARTER_TURN = 1.57079633f; /* integral of 1 over the front; that of cos a is 1 */

static const float vndf_front_q[VNDF_FRONT_CELLS + 1] = {
    0.0f, 0.0579879805f, 0.114377625f, 0.169473976f, 0.223526478f, 0.276737273f,
    0.329266846f, 0.381238043f, 0.432738632f, 0.483822674f, 0.534511149f, 0.584791899f,
    0.634619296f, 0.683913469f, 0.732559621f, 0.780407667f, 0.827271938f, 0.872932076f,
    0.917134225f, 0.959593892f, 1.0f};

static const float vndf_front_even_cdf[VNDF_FRONT_CELLS] = {
    0.0f, 0.115846229f, 0.227765464f, 0.335757727f, 0.439822962f, 0.539961242f,
    0.636172524f, 0.728456785f, 0.816814073f, 0.901244386f, 0.981747724f, 1.05832403f,
    1.13097335f, 1.1996957f, 1.26449103f, 1.32535941f, 1.38230076f, 1.43531517f,
    1.48440256f, 1.5295629f};

static const float vndf_front_even_mass[VNDF_FRONT_CELLS] = {
    0.115846229f, 0.111919236f, 0.107992263f, 0.104065234f, 0.10013828f, 0.096211282f,
    0.0922842606f, 0.0883572878f, 0.0844303138f, 0.080503338f, 0.0765763028f, 0.0726493252f,
    0.0687223482f, 0.0647953252f, 0.0608683842f, 0.0569413484f, 0.0530144121f, 0.0490873863f,
    0.0451603459f, 0.041233424f};

static const float vndf_front_even_density[VNDF_FRONT_CELLS + 1] = {
    2.0f, 1.99329733f, 1.97417339f, 1.94416092f, 1.90482706f, 1.85772861f,
    1.80437563f, 1.74620264f, 1.68454712f, 1.62063473f, 1.55557022f, 1.49033344f,
    1.42577929f, 1.36264136f, 1.30153798f, 1.24298017f, 1.18738132f, 1.13506707f,
    1.08628634f, 1.04122174f, 1.0f};

static const float vndf_front_cosine_cdf[VNDF_FRONT_CELLS] = {
    0.0f, 0.115587287f, 0.225801264f, 0.329484681f, 0.425779283f, 0.514102748f,
    0.594121072f, 0.665718877f, 0.728968616f, 0.784099826f, 0.831469624f, 0.871534921f,
    0.904827051f, 0.931928778f, 0.953454167f, 0.970031255f, 0.982287249f, 0.990836458f,
    0.996270379f, 0.999150023f};

static const float vndf_front_cosine_mass[VNDF_FRONT_CELLS] = {
    0.115587287f, 0.110213977f, 0.103683417f, 0.0962946017f, 0.0883234655f, 0.0800183241f,
    0.0715978045f, 0.0632497386f, 0.0551312104f, 0.0473697976f, 0.0400652978f, 0.03329213f,
    0.0271017263f, 0.0215253895f, 0.0165770883f, 0.0122559936f, 0.00854920852f, 0.00543392137f,
    0.00287964389f, 0.000849977189f};

static const float vndf_front_cosine_density[VNDF_FRONT_CELLS + 1] = {
    2.0f, 1.97993691f, 1.92318718f, 1.83560077f, 1.72353906f, 1.59342697f,
    1.45139578f, 1.30302101f, 1.15315188f, 1.00582219f, 0.864228481f, 0.73076032f,
    0.607067301f, 0.49415011f, 0.392463128f, 0.302019534f, 0.222493084f, 0.153310188f,
    0.0937316699f, 0.0429209727f, 0.0f};

#endif
