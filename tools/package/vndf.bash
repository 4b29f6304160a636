# Completion of bash for vndf: commands, the options that the help of a command names, and files.
_vndf()
{
    local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words='' files=-f
    if ((COMP_CWORD == 1)) || [[ $command == help ]]; then
        files='' words="$("$1" --help | sed -n 's/^  \([a-z]*\) .*/\1/p') help --help --version --man"
    elif [[ $current == -* ]]; then
        words=$("$1" help $command 2>/dev/null | grep -E '^ {2,4}-' | grep -oE -- '(^ +|, )-[-a-z0-9]+' | tr -d ' ,')
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" $files -- "$current")
}
complete -o filenames -F _vndf vndf
