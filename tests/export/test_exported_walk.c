/* A random walk on a mirror that loses nothing (Heitz et al., "Multiple-Scattering Microfacet BSDFs with the Smith
 * Model", SIGGRAPH 2016) with Lambda and samples of the exported C keeps the light: weights, visible over drawn density
 * at each event, are 1 in the mean within 4.5 sigma, and less than 1 of 1000 walks is longer than 64 events. */
#include "export/exported_subject.h"

#include "cli/random.h"
#include "cli/subject.h"
#include "harness/test.h"

static const float roughnesses[][2] = {{0.05f, 0.05f}, {0.3f, 0.3f}, {1, 1}, {0.1f, 1}};
static const double angles[] = {0, 60, 85, 89.9};
enum { ROUGHNESSES = 4, ANGLES = 4, EVENTS = 64 };

/* The part of heights below; walks begin at 1. INFINITY for a walk that leaves. */
static double next_height(double below, double z, double lambda, double u)
{
    if (z > 0 && u > 1 - pow(below, lambda))
        return INFINITY;
    if (fabs(lambda) > 1e20)
        return below;
    return fmin(1, below / pow(1 - u, 1 / lambda));
}

static double lambda_of(exported_question *q, const float w[3])
{
    exported_answer a;
    memcpy(q->wi, w, sizeof q->wi);
    exported_answer_to(q, &a);
    return (double)a.lambda;
}

/* Meets a normal that faces -w; returns the event's weight. */
static double reflect(exported_question *q, float w[3], random_stream *stream)
{
    exported_answer a;
    double facing = 0;
    for (int i = 0; i < 3; i++)
        q->wi[i] = -w[i];
    q->u1 = random_float(stream);
    q->u2 = random_float(stream);
    exported_answer_to(q, &a);
    for (int i = 0; i < 3; i++)
        facing -= (double)w[i] * (double)a.wm[i];
    double out[3], size = 0;
    for (int i = 0; i < 3; i++) {
        out[i] = (double)w[i] + 2 * facing * (double)a.wm[i];
        size += out[i] * out[i];
    }
    for (int i = 0; i < 3; i++)
        w[i] = (float)(out[i] / sqrt(size));
    return (double)a.visible / (double)a.sampled;
}

/* What leaves; -1 if the walk is too long. */
static double walk(exported_question q, vndf_vec3 wi, random_stream *stream)
{
    double below = 1, weight = 1;
    float w[3] = {-wi.x, -wi.y, -wi.z};
    for (int event = 0; event <= EVENTS; event++) {
        below = next_height(below, (double)w[2], lambda_of(&q, w), random_double(stream));
        if (isinf(below))
            return weight;
        weight *= reflect(&q, w, stream);
    }
    return -1;
}

static void test_view(const exported_subjects *subjects, int subject, const float alpha[2], double angle,
                      size_t count)
{
    vndf_vec3 wi = direction_from(angle, 25);
    exported_question q = exported_question_of(subjects, subject, alpha[0], alpha[1], wi);
    random_stream stream = random_from((uint64_t)subject);
    double sum = 0, squares = 0, lost = 0;
    for (size_t i = 0; i < count; i++) {
        double weight = walk(q, wi, &stream);
        lost += weight < 0;
        weight = weight < 0 ? 1 : weight;
        sum += weight - 1;
        squares += (weight - 1) * (weight - 1);
    }
    double n = (double)count, error = sqrt(squares) / n;
    if (!(TEST(fabs(sum / n) <= 4.5 * error + 1e-4) & TEST(lost <= 1e-3 * n)))
        fprintf(stderr, "%s alpha %g %g, %g degrees: mean %.6f +- %.6f, %g lost\n",
                exported_subject_name(subjects, subject), (double)alpha[0], (double)alpha[1], angle, 1 + sum / n,
                error, lost);
}

int main(void)
{
    exported_subjects subjects;
    int loaded = TEST(exported_load_shipped(&subjects));
    for (int i = 0; loaded && i < subjects.count + 2; i++)
        for (int r = 0; r < ROUGHNESSES; r++)
            for (int a = 0; a < ANGLES; a++)
                test_view(&subjects, i, roughnesses[r], angles[a], test_amount(500, 3000, 10000));
    exported_free(&subjects);
    return test_done();
}
