/* Asks two exported kernels every question of their files, by ask.h in their language: `normals`, which embeds its
 * numbers, and `bsdf`, which reads those in numbers.f32. It is compiled as C99 and as C++11, by several compilers. */
#include <stdio.h>

#include "normals.h"
#include "bsdf.h"
#include "normals.h"

#include "bsdf_ask.h"
#include "normals_ask.h"

static float numbers[1 << 16];

int main(void)
{
    normals_question normal;
    bsdf_question hit;
    FILE *raw = fopen("numbers.f32", "rb");
    FILE *normals = fopen("normals.asked", "rb"), *of_normals = fopen("normals.said", "wb");
    FILE *hits = fopen("bsdf.asked", "rb"), *of_hits = fopen("bsdf.said", "wb");
    if (!raw || !normals || !of_normals || !hits || !of_hits || !fread(numbers, sizeof *numbers, 1 << 16, raw))
        return 2;
    while (fread(&normal, sizeof normal, 1, normals) == 1) {
        const normals_answer answer = normals_ask(normal);
        fwrite(&answer, sizeof answer, 1, of_normals);
    }
    while (fread(&hit, sizeof hit, 1, hits) == 1) {
        const bsdf_answer answer = bsdf_ask(numbers, hit);
        fwrite(&answer, sizeof answer, 1, of_hits);
    }
    return fclose(of_normals) != 0 || fclose(of_hits) != 0;
}
