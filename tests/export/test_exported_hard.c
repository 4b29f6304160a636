/* No input is too hard for the exported C: directions exactly along z, next to it, at and beside the horizon, straight
 * from below, of length 1 +- 1e-6, numbers 0, 1, next to both and to 1/2, roughness 0.02 to 1 on both axes, for every
 * shipped table, GGX and Beckmann. Normals are unit, above the surface and face wi, densities are finite and above 0
 * but from straight below, areas are at least the cosine, 0 <= Lambda, 0 <= G2 <= G1 <= 1. */
#include "export/exported_subject.h"

#include <float.h>

#include "cli/random.h"
#include "cli/subject.h"
#include "harness/test.h"
#include "measure/stress.h"

static const double angles[] = {0,    1e-7,    1e-4, 0.01,    30, 60,  85,    89,
                                89.9, 89.9999, 90,   90.0001, 91, 130, 179.9, 180};
static const double azimuths[] = {0, 90, 45, 200};
static const double lengths[] = {1, 1 + 1e-6, 1 - 1e-6};
static const float roughnesses[] = {0.02f, 0.1f, 0.5f, 1};
static const float edges[] = {0.0f, 0x1p-24f, 0.5f - 0x1p-25f, 0.5f, 0.5f + 0x1p-24f, 1 - 0x1p-24f, 1.0f};
enum {
    ANGLES = sizeof angles / sizeof *angles,
    AZIMUTHS = sizeof azimuths / sizeof *azimuths,
    LENGTHS = sizeof lengths / sizeof *lengths,
    ROUGHNESSES = sizeof roughnesses / sizeof *roughnesses,
    EDGES = sizeof edges / sizeof *edges
};

static vndf_vec3 direction(size_t index)
{
    double angle = angles[index / (AZIMUTHS * LENGTHS)], length = lengths[index % LENGTHS];
    vndf_vec3 w = direction_from(angle, azimuths[index / LENGTHS % AZIMUTHS]);
    vndf_vec3 scaled = {(float)(length * (double)w.x), (float)(length * (double)w.y),
                        angle == 90 ? 0.0f : (float)(length * (double)w.z)};
    return scaled;
}

static int is_good_sample(const exported_question *q, const exported_answer *a)
{
    vndf_vec3 wi = {q->wi[0], q->wi[1], q->wi[2]}, wm = {a->wm[0], a->wm[1], a->wm[2]};
    int unit = fabs(stress_length(wm) - 1) <= 4 * 0x1p-23 && wm.z >= 0;
    int blind = wi.x == 0 && wi.y == 0 && wi.z < 0;
    int dense = a->sampled > 0 && a->sampled <= FLT_MAX && a->pdf >= 0 && a->pdf <= FLT_MAX;
    int known = a->visible >= 0 && a->visible <= FLT_MAX && a->ndf >= 0 && a->ndf <= FLT_MAX;
    return unit && known && (blind || (dense && stress_turned_away(wi, wm) <= 2));
}

static int is_good_direction(const exported_question *q, const exported_answer *a)
{
    int area = a->area >= fmaxf(0.0f, q->wi[2]) * (1 - 1e-6f) && a->area <= FLT_MAX;
    int lambda = q->wi[2] < 0 ? a->lambda <= -1 : a->lambda >= -2e-6f;
    int g = a->g2 >= 0 && a->g2 <= a->g1 * (1 + 1e-5f) && a->g1 <= 1;
    return area && lambda && fabsf(a->lambda) <= FLT_MAX && g;
}

static void print_point(const char *name, const exported_question *q, const exported_answer *a)
{
    fprintf(stderr,
            "%s alpha %g %g wi %.9g %.9g %.9g u %.9g %.9g: wm %.9g %.9g %.9g, densities %g %g %g, D %g, area %g, "
            "Lambda %g, G1 %g, G2 %g\n",
            name, (double)q->xx, (double)q->yy, (double)q->wi[0], (double)q->wi[1], (double)q->wi[2],
            (double)q->u1, (double)q->u2, (double)a->wm[0], (double)a->wm[1], (double)a->wm[2], (double)a->sampled,
            (double)a->pdf, (double)a->visible, (double)a->ndf, (double)a->area, (double)a->lambda, (double)a->g1,
            (double)a->g2);
}

static void test_point(const char *name, const exported_question *q, size_t *shown)
{
    exported_answer a;
    exported_answer_to(q, &a);
    if (!(TEST(is_good_sample(q, &a)) & TEST(is_good_direction(q, &a))) && (*shown)++ < 5)
        print_point(name, q, &a);
}

static void test_surface(const exported_subjects *subjects, int subject, size_t which, size_t every,
                         random_stream *stream)
{
    const char *name = exported_subject_name(subjects, subject);
    size_t shown = 0;
    for (size_t i = which % every; i < ANGLES * AZIMUTHS * LENGTHS; i += every) {
        exported_question q = exported_question_of(subjects, subject, roughnesses[which / ROUGHNESSES],
                                                   roughnesses[which % ROUGHNESSES], direction(i));
        for (size_t j = 0; j < EDGES * EDGES + 8; j++) {
            q.u1 = j < EDGES * EDGES ? edges[j / EDGES] : random_float(stream);
            q.u2 = j < EDGES * EDGES ? edges[j % EDGES] : random_float(stream);
            test_point(name, &q, &shown);
        }
    }
}

int main(void)
{
    exported_subjects subjects;
    random_stream stream = random_from(5);
    int loaded = TEST(exported_load_shipped(&subjects));
    for (int i = 0; loaded && i < subjects.count + 2; i++)
        for (size_t which = 0; which < ROUGHNESSES * ROUGHNESSES; which++)
            test_surface(&subjects, i, which, test_amount(11, 1, 1), &stream);
    exported_free(&subjects);
    return test_done();
}
