"""Rules of the games and the matches played by them; `registry` lists the games."""
