/* What a kernel of `vndf export` is asked, and what it answers: plain floats, so that the same file of questions goes
 * to every language. Questions name a table by its place among the numbers of all of them. */
#ifndef TESTS_EXPORT_EXPORTED_H
#define TESTS_EXPORT_EXPORTED_H

/* C99 and C++11 read this header. */
#ifdef __cplusplus
extern "C" {
#endif

/* A surface, a direction, two uniform numbers. */
typedef struct exported_question {
    float distribution, xx, xy, yx, yy, mean_x, mean_y;
    float wi[3], u1, u2;
} exported_question;

/* The normal that is drawn, the density that comes with it, and what calls say of that normal and of wi: G2 is of wi
 * and the normal. Then a normal of two lobes, 0.6 of the surface and 0.4 of GGX with alpha 0.3. */
typedef struct exported_answer {
    float wm[3], sampled, pdf, visible, ndf, lambda, g1, g2, area;
    float mixed[3], mixed_sampled, mixed_pdf;
} exported_answer;

void exported_answer_to(const exported_question *question, exported_answer *answer);

#ifdef __cplusplus
}
#endif
#endif
