# Prints the words that the completion script of corpuscle offers. Usage: complete.bash SCRIPT LINE WORD...
source /usr/share/bash-completion/bash_completion
source "$1"
shift
compopt() { echo "compopt $*"; }
COMP_LINE=$1 COMP_POINT=${#1}
shift
COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_TYPE=9 COMP_KEY=9
_corpuscle
printf '%s\n' "${COMPREPLY[@]}"
