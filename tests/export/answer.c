/* answer QUESTIONS ANSWERS: asks an exported kernel every question of a file. C99 and C++11. */
#include <stdio.h>

#include "exported.h"

int main(int argc, char **argv)
{
    exported_question question;
    exported_answer answer;
    FILE *questions = argc == 3 ? fopen(argv[1], "rb") : NULL, *answers = questions ? fopen(argv[2], "wb") : NULL;
    if (!answers)
        return 2;
    while (fread(&question, sizeof question, 1, questions) == 1) {
        exported_answer_to(&question, &answer);
        if (fwrite(&answer, sizeof answer, 1, answers) != 1)
            return 2;
    }
    fclose(questions);
    return fclose(answers) != 0;
}
