/* What a kernel of `vndf export` is asked, and what it answers: plain floats, so that the same file of questions goes
 * to every language. Questions name a table by its place among the numbers of all of them. */
#ifndef TESTS_EXPORT_EXPORTED_H
#define TESTS_EXPORT_EXPORTED_H

/* C99 and C++11 read this header. */
#ifdef __cplusplus
extern "C" {
#endif

typedef struct exported_surface {
    float distribution, xx, xy, yx, yy, mean_x, mean_y;
} exported_surface;

/* A surface, a direction, two uniform numbers. */
typedef struct exported_question {
    exported_surface of;
    float wi[3], u1, u2;
} exported_question;

/* The normal that is drawn, the density that comes with it, and what calls say of that normal and of wi: G2 is of wi
 * and the normal. Then a normal of two lobes, 0.6 of the surface and 0.4 of GGX with alpha 0.3. */
typedef struct exported_answer {
    float wm[3], sampled, pdf, visible, ndf, lambda, g1, g2, area;
    float mixed[3], mixed_sampled, mixed_pdf;
} exported_answer;

/* The same of a BSDF: a surface, wi, three uniform numbers, and a direction to evaluate. */
typedef struct exported_hit {
    exported_surface of;
    float wi[3], u[3], wo[3];
} exported_hit;

/* A sample; f and density towards the given wo, and towards that of the sample. Optics are EXPORTED_ETA and so on. */
typedef struct exported_scattered {
    float wo[3], weight[3], sampled, lobe;
    float f[3], pdf, own_f[3], own_pdf;
} exported_scattered;

#define EXPORTED_ETA 1.5f
#define EXPORTED_F0   \
  {                   \
    0.0f, 0.04f, 0.9f \
  }
#define EXPORTED_CONDUCTOR_ETA \
  {                            \
    0.2f, 0.9f, 1.5f           \
  }
#define EXPORTED_CONDUCTOR_K \
  {                          \
    3.9f, 2.4f, 1.9f         \
  }

void exported_scatter_at(const exported_hit *hit, exported_scattered *scattered);

void exported_answer_to(const exported_question *question, exported_answer *answer);

#ifdef __cplusplus
}
#endif
#endif
