/* answer QUESTIONS ANSWERS: asks an exported kernel every question of a file, by ask.h in its language. It is compiled
 * as C99 and as C++11, by several compilers: KERNEL_FILE is what was exported with the prefix `kernel`; where it has no
 * numbers, KERNEL_RAW is the file that has them. */
#include <stdio.h>

#include KERNEL_FILE
#include "asked.h"

#ifdef KERNEL_RAW
#  define ASK(question) kernel_ask(numbers, question)
#else
#  define ASK(question) kernel_ask(question)
#endif

int main(int argc, char **argv)
{
    kernel_question question;
    FILE *questions = argc == 3 ? fopen(argv[1], "rb") : NULL, *answers = questions ? fopen(argv[2], "wb") : NULL;
    if (!answers)
        return 2;
#ifdef KERNEL_RAW
    static float numbers[1 << 16];
    FILE *raw = fopen(KERNEL_RAW, "rb");
    if (!raw || fread(numbers, sizeof *numbers, 1 << 16, raw) == 0)
        return 2;
    fclose(raw);
#endif
    while (fread(&question, sizeof question, 1, questions) == 1) {
        const kernel_answer answer = ASK(question);
        if (fwrite(&answer, sizeof answer, 1, answers) != 1)
            return 2;
    }
    fclose(questions);
    return fclose(answers) != 0;
}
