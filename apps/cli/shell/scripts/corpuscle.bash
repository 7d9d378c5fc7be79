# Completion of corpuscle in bash. It needs the functions of the package bash-completion. The program itself knows what may follow.
_corpuscle() {
    local cur words cword before line files=
    _get_comp_words_by_ref -n '=:' cur words cword || return
    COMPREPLY=()
    while IFS= read -r line; do
        if [[ $line == :files ]]; then files=yes; else COMPREPLY+=("$line"); fi
    done < <("${words[0]/#\~/$HOME}" __complete "${words[@]:1:cword}" 2>/dev/null)
    if [[ $files ]]; then _filedir; fi
    if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[.=] ]]; then compopt -o nospace; fi
    # bash replaces only what follows the last = or : of the word
    before=${cur%"${cur##*[=:]}"}
    COMPREPLY=("${COMPREPLY[@]#"$before"}")
}
complete -o default -F _corpuscle corpuscle
