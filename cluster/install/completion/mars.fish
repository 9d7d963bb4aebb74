# Completion for fish. The programs say themselves what they take (--list-options, which is described in
# host/shell/options/command_line.h), so this file knows no option.

# Candidates for a value that help calls $argv[1].
function __mars_values
    switch $argv[1]
        case FILM
            __fish_complete_suffix .mars
            __fish_complete_suffix .json
        case MODEL
            __fish_complete_suffix .json
        case FILE
            __fish_complete_path (commandline -ct)
        case DIR
            __fish_complete_directories (commandline -ct) ''
        case '*|*'
            string split '|' -- $argv[1]
    end
end

# The rows of --list-options of one kind that belong to a command.
function __mars_rows --argument-names kind command
    string match -- $kind\t$command\t'*' $__mars_list
end

function __mars
    set -l words (commandline -opc)
    type -q $words[1]; or return
    set -g __mars_list ($words[1] --list-options 2>/dev/null)
    set -l command (string split \t -- $__mars_list[1])[2]
    set -l given 0 # arguments of the command
    set -l asked # values that the last option still needs
    for word in $words[2..-1]
        if set -q asked[1]
            set -e asked[1]
        else if string match -q -- '-*' $word
            for row in (__mars_rows option $command)
                set -l fields (string split \t -- $row)
                contains -- $word (string split , -- $fields[3]); and test "$fields[4]" != -
                and set asked (string split ' ' -- $fields[4])
            end
        else if string match -q -- command\t"$command $word"\t'*' $__mars_list
            set command "$command $word"
            set given 0
        else
            set given (math $given + 1)
        end
    end
    if set -q asked[1]
        __mars_values $asked[1]
    else if string match -q -- '-*' (commandline -ct)
        for row in (__mars_rows option $command)
            set -l fields (string split \t -- $row)
            set -l help (string replace -r ' Example: .*' '' -- $fields[6])
            printf "%s\t$help\n" (string split , -- $fields[3])
        end
    else
        for row in (__mars_rows command "$command *")
            set -l fields (string split \t -- $row)
            set -l name (string replace "$command " '' -- $fields[2])
            string match -q '* *' -- $name; or printf '%s\t%s\n' $name $fields[3]
        end
        set -l arguments
        for row in (__mars_rows argument $command)
            set -l fields (string split \t -- $row)
            string match -q '*|*' -- $fields[4]; and set fields[3] $fields[4](string match -r '\.\.\.$' -- $fields[3])
            set -a arguments $fields[3]
        end
        if set -q arguments[1]
            set -l at (math min $given + 1, (count $arguments))
            test $at -gt $given; or string match -q '*...' -- $arguments[$at]
            and __mars_values (string replace ... '' -- $arguments[$at])
        end
    end
end

for program in mars mars-host mars-ranks mars-threads mars-simulated mars-nx
    complete -c $program -f -a '(__mars)'
end
