# Prints the function that completes corpuscle. Usage: complete.zsh FOLDER_OF_SCRIPTS
fpath=($1 $fpath)
autoload -U compinit
compinit -D -u
print $_comps[corpuscle]
