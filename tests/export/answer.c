/* answer QUESTIONS ANSWERS: asks an exported kernel, or a BSDF, every question of a file. C99 and C++11. */
#include <stdio.h>

#include "exported.h"

#ifdef KERNEL_SCATTERS
typedef exported_hit question_of;
typedef exported_scattered answer_of;
#  define ASK exported_scatter_at
#else
typedef exported_question question_of;
typedef exported_answer answer_of;
#  define ASK exported_answer_to
#endif

int main(int argc, char **argv)
{
    question_of question;
    answer_of answer;
    FILE *questions = argc == 3 ? fopen(argv[1], "rb") : NULL, *answers = questions ? fopen(argv[2], "wb") : NULL;
    if (!answers)
        return 2;
    while (fread(&question, sizeof question, 1, questions) == 1) {
        ASK(&question, &answer);
        if (fwrite(&answer, sizeof answer, 1, answers) != 1)
            return 2;
    }
    fclose(questions);
    return fclose(answers) != 0;
}
