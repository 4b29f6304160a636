/* Wrong words are refused with exit status 2, in a line that names the word and what would be right, and no command
 * that failed leaves a file behind. It notices a hint that is lost and an option that is taken for another one. */
#include "harness/run_program.h"

#define TABLE(name) VNDF_SOURCE_DIR "/tables/" name ".vndf"
#define SMALL TABLE("student-t-2.5-small")
#define MANY SMALL " " TABLE("hazy") " " TABLE("student-t-2.5") " " TABLE("example")

static const struct {
    const char *says, *words;
} refusals[] = {
    {"a command is missing", ""},
    {"did you mean 'sample'?", "smaple"},
    {"did you mean '--version'?", "--versoin"},
    {"did you mean `vndf info a.vndf`?", "a.vndf"},
    {"there is no command 'bulid'; did you mean 'build'?", "help bulid"},
    {"one word too many", "help build sample"},
    {"did you mean '--theta'?", "sample ggx --thta 3"},
    {"did you mean '--alpha'?", "sample ggx -a 3"},
    {"did you mean '--theta'?", "sample ggx --the 3"},
    {"did you mean '--max-bytes'?", "build --slope 'exp(-r)' --bytes 4096 -o x.vndf"},
    {"did you mean '-o'?", "sample ggx --output x.csv"},
    {"lists have commas, as in 1,2", "sample ggx --alpha 0.3 0.1 --theta 1 -n 9 -o x.csv"},
    {"--theta needs a value", "sample ggx --theta"},
    {"--theta is given twice", "sample ggx --theta 1 --theta 2 -n 9 -o x.csv"},
    {"FILE|ggx|beckmann|FILE.vndfs is missing", "info"},
    {"'beckmann' is not expected; words that are no options are only FILE", "info ggx beckmann"},
    {"cannot read missing.vndf: No such file", "info missing.vndf"},
    {"did you mean 'ggx'?", "info GXG"},
    {"cannot read .: Is a directory", "info ."},
    {"text.txt: not a vndf table: it must begin", "info text.txt"},
    {"a single table is needed (sample takes", "check two.vndfs@2"},
    {"exactly one is needed of --ndf", "build -o x.csv"},
    {"--slope and --family are given; only one is possible", "build --slope 'exp(-r)' --family ggx -o x.csv"},
    {"-o FILE is missing", "build --slope 'exp(-r)'"},
    {"did you mean '--max-tv'?", "build --slope 'exp(-r)' --maxtv 1e-3 -o x.csv"},
    {"did you mean '--set a=0.3'?", "build --slope 'exp(-a*r)' -a 0.3 -o x.csv"},
    {"did you mean '--set a=0.3'?", "build --slope 'exp(-a*r)' --a=0.3 -o x.csv"},
    {"did you mean '--set a=3'?", "build --slope 'exp(-a*r)' a=3 -o x.csv"},
    {"`vndf build --list` has them", "build --family alum-bronze -o x.csv"},
    {"--slope: column 8: unexpected ')'", "build --slope 'exp(-r))' -o x.csv"},
    {"a formula is --slope 'EXPR'", "build 'exp(-r)' -o x.csv"},
    {"-o needs a value, as in -o FILE", "build --slope 'exp(-r)' -o"},
    {"has its value by --set NAME=X", "build --slope 'exp(-a*r)' -o x.csv"},
    {"did you mean 'cos'?", "build --slope 'exp(-r)*cso(r)' -o x.csv"},
    {"NAME=NUMBER", "build --slope 'exp(-r)' --set k -o x.csv"},
    {"--set is for --ndf and --slope", "build --family ggx --set k=1 -o x.csv"},
    {"parameter 'b': the formula 'exp(-a*r)' has no 'b'",
     "build --slope 'exp(-a*r)' --set a=1 --set b=2 -o x.csv"},
    {"cannot read missing.csv", "build --csv missing.csv -o x.csv"},
    {"stdin: line 1", "build --csv - -o x.csv"},
    {"from 2048 to 1048576", "build --slope 'exp(-r)' --max-bytes 100 -o x.csv"},
    {"'KiB' stands behind it", "build --slope 'exp(-r)' --max-bytes 4KiB -o x.csv"},
    {"--moments '5' is not 2, 3 or 4", "build --slope 'exp(-r)' --moments 5 -o x.csv"},
    {"4 moments leave 0.0002", "build --slope 'exp(-r)' --max-bytes 2048 --max-tv 1e-9 -o x.csv"},
    {"cannot write 'no/x.vndf': No such file", "build --slope 'exp(-r)' -o no/x.vndf"},
    {"'.' is a folder", "build --slope 'exp(-r)' -o ."},
    {"known by .vndfs, and this is one table", "build --slope 'exp(-r)' -o x.vndfs"},
    {"--parameter is for --family", "build --slope 'exp(-r)' --parameter 1..2 -o x.csv"},
    {"--knots is for --parameter", "build --family student-t:2 --knots 3 -o x.csv"},
    {"--knots and --max-tv are given",
     "build --family student-t --parameter 2..3 -o x.vndfs --knots 3 --max-tv 0.1"},
    {"--parameter '2' is not LOW..HIGH", "build --family student-t --parameter 2 -o x.vndfs"},
    {"--parameter 'x' is not a number", "build --family student-t --parameter x..3 -o x.vndfs"},
    {"the first must be below the second", "build --family student-t --parameter 3..2 -o x.vndfs"},
    {"--knots '1' is not in the range from 2 to 256",
     "build --family student-t --parameter 2..3 -o x.vndfs --knots 1"},
    {"has to end in .vndfs", "build --family student-t --parameter 2..3 -o x.csv"},
    {".csv or .f32", "sample ggx --theta 60 -n 9 -o a.txt"},
    {"--theta DEG is missing", "sample ggx -n 9 -o x.csv"},
    {"-n N is missing", "sample ggx --theta 60 -o x.csv"},
    {"-n '1.5' is not a whole number", "sample ggx --theta 60 -n 1.5 -o x.csv"},
    {"--theta '0x10' is not a number", "sample ggx --theta 0x10 -n 9 -o x.csv"},
    {"--alpha '0' is not in the range", "sample ggx --theta 60 -n 9 -o x.csv --alpha 0"},
    {"--alpha '1,2,3' has too many numbers: it takes 2", "sample ggx --theta 60 -n 9 -o x.csv --alpha 1,2,3"},
    {"--alpha '0.1,1e400' is too large", "sample ggx --theta 60 -n 9 -o x.csv --alpha 0.1,1e400"},
    {"FILE|ggx|beckmann|FILE.vndfs@P is missing", "sample --theta 60 -n 9 -o x.csv"},
    {"--alpha and --matrix are given", "sample ggx --theta 60 -n 9 -o x.csv --alpha 1 --matrix 1,0,0,1"},
    {"--matrix '1,0,1' has too few numbers: it takes 4", "sample ggx --theta 60 -n 9 -o x.csv --matrix 1,0,1"},
    {"--matrix '1,2,2,4' is singular", "sample ggx --theta 60 -n 9 -o x.csv --matrix 1,2,2,4"},
    {"say at which parameter, as in two.vndfs@2.5", "sample --theta 60 -n 9 -o x.csv two.vndfs"},
    {"'3.1' is not in the range of the family, from 1.8 to 3", "sample --theta 60 -n 9 -o x.csv two.vndfs@3.1"},
    {"the parameter 'x' is not a number", "sample two.vndfs@x --theta 60 -n 9 -o x.csv"},
    {"must end in .svg", "plot ggx -o x.png"},
    {"must end in .csv, .md or .json", "bench --only caps -o x.txt"},
    {"vndf bench: no method or distribution has 'sphercial' in its name; did you mean 'spherical'?",
     "bench --only sphercial"},
    {"no set of effects or distribution has 'no-such-effect'", "bench --effects --only no-such-effect"},
    {"--theta '90' is not in the range", "bench --effects --theta 90"},
    {"--theta is for --effects", "bench --theta 80"},
    {"unknown family 'nonsense'", "bench --family nonsense"},
    {"cannot write 'no/a.csv'", "bench --only ggx --seconds 0.1 -o no/a.csv"},
    {"--with: column 1: unknown family 'foo'", "report --with foo x"},
    {"DIR is missing", "report"},
    {"'.' has files in it, and no page of `vndf report`", "report ."},
    {"'text.txt' is no folder", "report text.txt"},
    {"cannot make the folder 'no/x'", "report no/x"}, /* before anything is measured */
    {"column", "report --slope 'exp(-r' x"},
    {"--samples '10' is not in the range", "check ggx --samples 10"},
    {"a closed form was not made of a CSV", "check ggx --csv text.txt"},
    {"did you mean 'cuda'?", "export " SMALL " --language cudaa -o x"},
    {"--language is missing", "export " SMALL " -o x"},
    {"FILE is missing", "export --language c -o x"},
    {"-o OUT is missing", "export " SMALL " --language c"},
    {"-n '1.5' is not a whole", "sample ggx --theta 60 -n=1.5 -o x.csv"},
    {"there is no option '-nten'; did you mean '-n'?", "sample ggx --theta 60 -nten -o x.csv"},
    {"did you mean '--set a=3'?", "build --slope 'exp(-a*r)' -a=3 -o x.csv"},
    {"numbers cannot be embedded in GLSL", "export " MANY " --language glsl -o x"},
    {"use --buffer FILE, or smaller tables: vndf build --max-bytes", "export " MANY " --language wgsl -o x"},
    {"which is taken; rename the file", "export " SMALL " " SMALL " --language c -o x"},
    {"--buffer and -o both name", "export " SMALL " --language c --buffer ./x -o x"},
    {"--buffer '-': a file is needed", "export " SMALL " --language c --buffer - -o x"},
    {"a family is a mixture of two tables; --lobes 2", "export two.vndfs --language c --lobes 1 -o x"},
    {"--lobes '9' is not in the range", "export " SMALL " --language c --lobes 9 -o x"},
    {"--prefix 'a-b': a lower-case letter", "export " SMALL " --language c --prefix a-b -o x"},
    {"--prefix 'a__b'", "export " SMALL " --language c --prefix a__b -o x"},
    {"--prefix 'a_'", "export " SMALL " --language c --prefix a_ -o x"},
    {"--prefix '2d'", "export " SMALL " --language c --prefix 2d -o x"},
    {"--prefix 'gl'", "export " SMALL " --language c --prefix gl -o x"},
    {"did you mean 'sample'?", "export " SMALL " --language c --only smple,sample -o x"},
    {"a BSDF needs --bsdf", "export " SMALL " --language c --only bsdf_eval -o x"},
    {"did you mean 'both'?", "export " SMALL " --language c --bsdf bth -o x"},
    {"is for --bsdf, which is not given", "export " SMALL " --language c --fresnel schlick -o x"},
    {"VNDF_FRESNEL_NONE", "export " SMALL " --language c --bsdf both -o x"},
    {"--prefix is for kernels, not for --rgl", "export ggx --rgl --prefix a -o x"},
    {"-o PAGE.html is missing", "explore " SMALL},
    {"--engines '3' is not in the range", "explore " SMALL " --engines 3 -o x"},
};

int main(void)
{
    char folder[] = "cli.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    run_line(0, "",
             "echo text >text.txt; vndf build --family student-t --parameter 1.8..3 --knots 2 --max-bytes 2048 "
             "-q -o two.vndfs");
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++)
        run_line(2, refusals[i].says, "vndf %s", refusals[i].words);
    run_line(0, "", "for n in -n9 -n=9 '-n 9'; do vndf sample ggx --theta=60 $n -o -; done | wc -l | grep -x 30");
    run_line(0, "", "vndf export ggx beckmann --language c -o x.h && rm x.h");
    run_line(2, "cannot read stdin: it is read already", "vndf export - - --language c -o x.h <" SMALL);
    TEST(remove("text.txt") == 0 && remove("two.vndfs") == 0);
    return run_end(folder);
}
