/* For a GPU of NVIDIA a view and a sample of a table take at most 64 registers, and neither they nor a mixture of two
 * tables nor a BSDF have local memory, which an index by a variable makes: the commands at the head of
 * tools/export/examples/gpu.cu compile it. Where a GPU is, it runs, and no sample is bad. */
#include "harness/run_program.h"

int main(void)
{
    char folder[] = "registers.XXXXXX", name[200];
    int kernels = 0, stack, stores, used;
    if (!run_begin(folder))
        return test_done();
    const run_outcome *o =
        run_line(0, "",
                 "PATH=$PATH:/usr/local/cuda/bin; command -v nvcc >/dev/null || { echo SKIPPED: no nvcc; exit; }\n"
                 "set -e; TABLES=%s/tables; examples=%s/tools/export/examples; arch=sm_80; gpu=true\n"
                 "if [ -e /dev/nvidia0 ]; then arch=native; gpu=./gpu; fi\n"
                 "sed -n \"s|^ \\*     ||p\" $examples/gpu.cu |\n"
                 "sed \"s|-arch=native -I. |-arch=$arch -Xptxas -v -I. $examples/|; s|^./gpu|$gpu|\" >commands\n"
                 ". ./commands; rm -f commands gpu *.cuh *.f32",
                 VNDF_SOURCE_DIR, VNDF_SOURCE_DIR);
    for (const char *at = o->text; (at = strstr(at, "properties for ")) != NULL; at++) {
        if (sscanf(at,
                   "properties for %199s %d bytes stack frame, %d bytes spill stores, %*d bytes spill loads "
                   "ptxas info : Used %d",
                   name, &stack, &stores, &used) != 4)
            continue;
        const int is_sample = strstr(name, "normals") || strstr(name, "embedded");
        if (!(TEST(stack + stores == 0) & TEST(used <= (is_sample ? 64 : 255))))
            fprintf(stderr, "  %s: %d bytes of local memory, %d registers\n", name, stack + stores, used);
        kernels++;
    }
    if (strncmp(o->text, "SKIPPED", 7) == 0)
        puts(o->text);
    else
        TEST(kernels == 9);
    return run_end(folder);
}
