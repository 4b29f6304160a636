/* Above the horizon no weight is far from the mean, whatever D is: within 1e-2 with three moments and 1.5e-3 with four,
 * but in the cell that holds rho, where the law changes at a knot and k~ is up to 2e-2 from k, and for what cells miss
 * at jumps and needles; the variance is small, and the mean is 1: the area is right. Random D of up to five lobes -
 * needles, rings, discs, tails, gaps - are built, and looked at from 60 directions. It notices a wrong power, a switch
 * at the wrong knot, and a cell whose law has the mass and not the shape. */
#include "sampler/seen.h"
#include "vndf_build.h"

enum { DIRECTIONS = 60 };

/* A random slope formula; the widths of its lobes are up to 1e3 apart. */
static void random_formula(char text[1024], unsigned long long *state)
{
    int lobes = 1 + (int)(test_random_bits(state) % 5);
    for (int i = 0; i < lobes; i++) {
        double w = random_decade(state, -1.5, 1.5), power = random_between(state, 1.6, 4),
               width = random_decade(state, -2, -0.3), height = random_decade(state, -1, 1) / (w * w);
        text += sprintf(text, "%s", i ? "+" : "");
        switch (test_random_bits(state) % 5) {
        case 0: text += sprintf(text, "%.6g*exp(-(r/%.6g)^2)", height, w); break;
        case 1: text += sprintf(text, "%.6g*(1+(r/%.6g)^2)^-%.4g", height, w, power); break;
        case 2: text += sprintf(text, "%.6g*exp(-r/%.6g)", height, w); break;
        case 3: text += sprintf(text, "%.6g*exp(-((r/%.6g-1)/%.4g)^2)", height / width, w, width); break;
        default: text += sprintf(text, "%.6g*step(%.6g-r)", height, w);
        }
    }
}

static void test_table(const vndf_distribution *d, const char *text, size_t samples)
{
    const double limit = 2.5e-2, fine = 1e-3; /* of a weight over the mean; of the mean, and of the variance */
    unsigned long long state = 3;
    for (int i = 0; i < DIRECTIONS; i++) {
        double theta = i < 40 ? 2.25 * i : 90 - 10 * pow(0.6, i - 40), low = HUGE_VAL, high = 0, mean = 0,
               square = 0;
        const vndf_surface surface = vndf_rough(d, i % 3 ? 0.5f : 1, i % 2 ? 0.5f : 0.1f);
        const vndf_view view = vndf_view_from(&surface, oracle_direction(theta, 25 * i));
        for (size_t j = 0; j < samples; j++) {
            float weight, u1 = test_uniform(&state), u2 = test_uniform(&state);
            vndf_sample_weight(&view, u1, u2, NULL, &weight);
            low = fmin(low, (double)weight), high = fmax(high, (double)weight);
            mean += (double)weight / (double)samples;
            square += ((double)weight - 1) * ((double)weight - 1) / (double)samples;
        }
        if (!(TEST(low >= (1 - limit) * mean && high <= (1 + limit) * mean) & TEST(fabs(mean - 1) < fine) &
              TEST(square - (mean - 1) * (mean - 1) < fine)))
            fprintf(stderr, "  at %.3g weights %.5f to %.5f, mean %.5f, square %.2g: %s\n", theta, low, high, mean,
                    square, text);
    }
}

int main(void)
{
    unsigned long long state = 2026;
    for (size_t i = 0; i < test_amount(6, 60, 300); i++) {
        const vndf_build_options options = {.max_bytes = i % 2 ? 32768 : 16384, .moments = i % 2 ? 4 : 3};
        char text[1024];
        vndf_error error = {VNDF_OK, ""};
        random_formula(text, &state);
        vndf_source *source = vndf_source_slope_expression(text, NULL, 0, &error);
        vndf_distribution *d = source ? vndf_build(source, &options, NULL, &error) : NULL;
        if (TEST(d != NULL))
            test_table(d, text, test_amount(200, 400, 1000));
        else
            fprintf(stderr, "  %s: %s\n", text, error.message);
        vndf_free(d);
        vndf_source_free(source);
    }
    return test_done();
}
