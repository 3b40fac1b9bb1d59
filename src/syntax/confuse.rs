//! What a scanner or a typist makes of a word: letters of the same shape, and edit distance.

/// Letters that look alike in print. A letter may be in several groups.
const ALIKE: [&str; 16] = [
    "lIi1|", "oO0Q", "sS5", "S8", "B8", "bh", "b6", "G6", "zZ2", "qg9", "uv", "vy", "vw", "ceC",
    "tf", "nh",
];

/// Letters that a scanner takes for two.
const PAIRS: [(u8, &[u8]); 4] = [(b'm', b"rn"), (b'm', b"nn"), (b'w', b"vv"), (b'd', b"cl")];

/// Two digits that a scanner takes for one letter.
const JOINED: (u8, &[u8]) = (b'B', b"13");

/// Longest word for which a likeness is looked for: more than the longest mnemonic with its suffixes.
const LONGEST: usize = 28;

/// Whether the letter `written` can be a misreading of the letter `meant` (lower case).
pub(super) fn alike(written: u8, meant: u8) -> bool {
    let same_group = |group: &&str| {
        let group = group.as_bytes();
        group.contains(&written)
            && (group.contains(&meant) || group.contains(&meant.to_ascii_uppercase()))
    };
    written.eq_ignore_ascii_case(&meant) || ALIKE.iter().any(same_group)
}

/// Whether `written` can be a misreading of `meant`, or is the same in another case of letters.
pub(super) fn reads_as(written: &str, meant: &str) -> bool {
    fn rest(written: &[u8], meant: &[u8]) -> bool {
        let Some((&m, meant_after)) = meant.split_first() else {
            return written.is_empty();
        };
        if written.first() == Some(&JOINED.0)
            && meant.starts_with(JOINED.1)
            && rest(&written[1..], &meant[JOINED.1.len()..])
        {
            return true;
        }
        let one = written
            .split_first()
            .is_some_and(|(&w, after)| alike(w, m) && rest(after, meant_after));
        one || PAIRS.iter().any(|&(letter, pair)| {
            letter == m.to_ascii_lowercase()
                && written
                    .get(..2)
                    .is_some_and(|two| two.eq_ignore_ascii_case(pair))
                && rest(&written[2..], meant_after)
        })
    }
    written.len() <= LONGEST && rest(written.as_bytes(), meant.as_bytes())
}

/// What a letter stands for in a number: itself, or the digits that it can be a misreading of.
pub(super) fn digits_of(letter: char) -> Vec<String> {
    let written = letter.to_string();
    if letter.is_ascii_digit() {
        return vec![written];
    }
    let joined = std::str::from_utf8(JOINED.1).unwrap_or("");
    let candidates = (b'0'..=b'9').map(|digit| char::from(digit).to_string());
    let readings: Vec<String> = candidates
        .chain([joined.to_string()])
        .filter(|meant| reads_as(&written, meant))
        .collect();
    if readings.is_empty() {
        vec![written]
    } else {
        readings
    }
}

/// The one candidate that `written` can be a misreading of; `None` if there is none or more than one.
pub(super) fn only_reading<T>(
    written: &str,
    candidates: impl Iterator<Item = (T, String)>,
) -> Option<(T, String)> {
    let mut fitting = readings(written, candidates);
    let first = fitting.next()?;
    fitting.next().is_none().then_some(first)
}

/// All candidates that `written` can be a misreading of.
pub(super) fn readings<T>(
    written: &str,
    candidates: impl Iterator<Item = (T, String)>,
) -> impl Iterator<Item = (T, String)> {
    // Where every letter would be another, it is not a misreading but another word.
    let shares = move |name: &str| {
        let mut letters = written.bytes();
        letters.any(|b| name.bytes().any(|n| n.eq_ignore_ascii_case(&b)))
    };
    candidates.filter(move |(_, name)| reads_as(written, name) && shares(name))
}

/// How many letters must be changed, added, dropped or swapped with their neighbour, in any case of letters.
pub(crate) fn distance(a: &str, b: &str) -> usize {
    if a.len() > LONGEST || b.len() > LONGEST {
        return usize::MAX;
    }
    let a = a.to_ascii_lowercase().into_bytes();
    let b = b.to_ascii_lowercase().into_bytes();
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            let mut least = (rows[i - 1][j - 1] + change)
                .min(rows[i - 1][j] + 1)
                .min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}
