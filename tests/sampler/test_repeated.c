/* The density that comes with a sample is that of vndf_pdf at the normal returned (promise 2): above the horizon within
 * 1e-5 for 99.9% of the samples and 1e-4 for 99.99%, below it 1e-4 and 1e-3, where roughness is at least 0.02 and no
 * lobe of D is narrower than a tenth of its slope; every fifth view is of a mixture. It notices a density that is
 * formed another way where a sample is drawn than where it is asked for, and digits lost on the way. */
#include "cli/sort.h"
#include "sampler/seen.h"

enum { ALPHAS = 4, MOST = 400000 };
static const float alphas[ALPHAS] = {0.02f, 0.1f, 0.3f, 1};

/* Of views that see at least 1e-8 of what is seen at grazing incidence. */
static size_t measure(const subject *of, int below, size_t samples, double *error, unsigned long long *state)
{
    size_t count = 0;
    for (size_t i = 0; i < samples; i++) {
        float ax = alphas[i % ALPHAS], ay = i / ALPHAS % 2 ? ax : alphas[i / 8 % ALPHAS], pdf;
        vndf_vec3 wi = random_direction(state, 0);
        wi.z = below ? -wi.z : wi.z;
        const vndf_mixture two = {2, {{seen_straight(of->d, ax, ay), 0.3f}, {seen_straight(of->d, 1, 1), 0.7f}}};
        seen s = i % 5 == 4 ? seen_from(SEEN_MIXTURE, &two, wi) : seen_surface(of->d, ax, ay, wi);
        if (!seen_at_all(&s, 1e-8f))
            continue;
        vndf_vec3 wm = seen_draw(&s, test_uniform(state), test_uniform(state), &pdf);
        double apart = fabs((double)seen_pdf(&s, wm) / (double)pdf - 1);
        error[count++] = apart < 1e30 ? apart : 1e30;
    }
    sort_numbers(error, count);
    return count;
}

static void test_subject(const subject *of, size_t index)
{
    static double error[MOST];
    unsigned long long state = 31 + index;
    for (int below = 0; below < 2; below++) {
        size_t count = measure(of, below, test_amount(20000, 100000, MOST), error, &state);
        if (count < 1000)
            continue;
        double often = error[count - 1 - count / 1000], rare = error[count - 1 - count / 10000];
        double limit = (below ? 1e-4 : 1e-5) * (of->shape.breaks[0] > 0 ? 3 : 1); /* a jump is narrow */
        if (!(TEST(often <= limit) & TEST(rare <= 10 * limit)) || test_long())
            fprintf(stderr, "  %s %s: 50%% %.2g, 99.9%% %.2g, 99.99%% %.2g, most %.2g of %lu\n", of->name,
                    below ? "below" : "above", error[count / 2], often, rare, error[count - 1],
                    (unsigned long)count);
    }
}

int main(int arguments, char **argument)
{
    return subjects_test(arguments, argument, test_subject);
}
