"""Games from elsewhere: packages beside this one, in the user's folder, or installed. Knows no game itself."""
