# Completion of corpuscle in fish. The program itself knows what may follow.
function __corpuscle_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l found ($words[1] __complete $words[2..-1] "$current" 2>/dev/null)
    string match --invert -- :files $found
    if contains -- :files $found
        __fish_complete_path "$current"
    end
end
complete --command corpuscle --no-files --arguments '(__corpuscle_complete)'
